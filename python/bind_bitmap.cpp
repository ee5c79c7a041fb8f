// bitmap: paper 2's samples of borders, a picture that can be queried.
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <nlohmann/json.hpp>

#include "bind_grid.hpp"
#include "bind_region.hpp"
#include "binding.hpp"
#include "fairway/bitmap/bitmap_file.hpp"
#include "fairway/bitmap/sample_bitmap.hpp"
#include "fairway/exchange/plan_rasters.hpp"
#include "fairway/report/draw_reachability.hpp"
#include "fairway/run/ask_bitmap.hpp"
#include "fairway/run/bitmap_verification.hpp"

namespace fairway::python {
namespace {

using namespace pybind11::literals;

struct HeldBitmap {
  const Bitmap bitmap;
};

std::shared_ptr<HeldBitmap> draw(const std::shared_ptr<HeldPlan>& plan, const py::object& region,
                                 int samples, std::uint64_t seed) {
  if (samples < least_border_samples || samples > most_border_samples || samples % 4 != 0) {
    throw py::value_error(fmt::format("samples: expected a multiple of four, {} to {}",
                                      least_border_samples, most_border_samples));
  }
  const RegionOfInterest of_interest = region_from(region, plan->plan);
  const py::gil_scoped_release unlocked;
  return std::make_shared<HeldBitmap>(
      HeldBitmap{draw_bitmap(plan->plan, "plan", of_interest, samples, seed).bitmap});
}

std::vector<std::int8_t> codes_of(const std::vector<Sampled>& answers) {
  std::vector<std::int8_t> codes;
  codes.reserve(answers.size());
  for (const Sampled answer : answers) codes.push_back(static_cast<std::int8_t>(answer));
  return codes;
}

py::array query(const HeldBitmap& held, const py::object& rows) {
  const std::vector<State> states = states_of(rows, "states");
  std::vector<std::int8_t> codes;
  {
    const py::gil_scoped_release unlocked;
    codes = codes_of(sampled_answers(held.bitmap, states));
  }
  return owning(std::move(codes));
}

py::array reach_map(const HeldBitmap& held, double heading_rad) {
  if (!std::isfinite(heading_rad)) throw py::value_error("heading_rad: is not finite");
  std::vector<std::int8_t> codes;
  {
    const py::gil_scoped_release unlocked;
    codes = codes_of(sampled_at(held.bitmap, Heading::from_rad(heading_rad)));
  }
  const Grid& grid = held.bitmap.grid();
  return owning(std::move(codes)).attr("reshape")(grid.ny, grid.nx);
}

py::array border(const HeldBitmap& held, int ix, int iy, const std::string& side_name) {
  const auto side = choice_of<Side>(
      "side", side_name,
      {{"right", Side::right}, {"top", Side::top}, {"left", Side::left}, {"bottom", Side::bottom}});
  const BorderBitmap& set = held.bitmap.set;
  const BorderNumbers borders = set.borders();
  if (!set.grid.contains({ix, iy}) || !borders.is_inner({ix, iy}, side)) {
    throw py::index_error("ix, iy, side: no border between two cells of the plan");
  }
  std::vector<std::uint8_t> bits;
  for (int k = 0; k < set.samples; ++k) {
    for (int i = 0; i < set.samples; ++i) {
      bits.push_back(set.reached(borders.of({ix, iy}, side), k, i) ? 1 : 0);
    }
  }
  return owning(std::move(bits)).attr("reshape")(set.samples, set.samples);
}

py::array words(const py::object& self) {
  const BorderBitmap& set = self.cast<const HeldBitmap&>().bitmap.set;
  const auto each = static_cast<py::ssize_t>(set.words_per_border());
  return view(set.words.data(), {static_cast<py::ssize_t>(set.borders().count()), each},
              {8 * each, 8}, self);
}

void save_geotiff(const HeldBitmap& held, const std::filesystem::path& path,
                  const std::optional<std::vector<double>>& headings_rad, bool force) {
  std::vector<Heading> headings;
  for (const double rad : headings_rad.value_or(std::vector<double>{})) {
    if (!std::isfinite(rad)) throw py::value_error("headings_rad: not all are finite");
    headings.push_back(Heading::from_rad(rad));
  }
  if (!headings_rad) headings = even_headings(ReachabilityMapOptions{}.headings);
  const py::gil_scoped_release unlocked;
  write_sampled_raster(held.bitmap.grid(), held.bitmap.frame.value_or(Frame{}),
                       sampled_layers(held.bitmap, headings), path,
                       force ? Existing::replace : Existing::keep);
}

Picture picture(const HeldBitmap& held, int headings, const std::string& title) {
  const py::gil_scoped_release unlocked;
  ReachabilityMapOptions options;
  options.headings = headings;
  options.headings_per_sample = 0;
  return draw_reachability_slices(reachability_map_of(held.bitmap, options), {.title = title});
}

Picture shares_picture(const HeldBitmap& held, const std::string& title) {
  const py::gil_scoped_release unlocked;
  ReachabilityMapOptions options;
  options.headings = 1;
  return draw_reachability_shares(reachability_map_of(held.bitmap, options), {.title = title});
}

}  // namespace

void bind_bitmap(py::module_& m) {
  std::vector<std::pair<const char*, int>> codes;
  codes.emplace_back("undecided", static_cast<int>(Sampled::undecided));
  codes.emplace_back("reach", static_cast<int>(Sampled::reach));
  codes.emplace_back("other", static_cast<int>(Sampled::other));
  add_enum(m, "Sampled",
           "What a bitmap's samples show for a state: they reach, they do not, or they disagree. "
           "Not a verdict.",
           codes);

  py::class_<HeldBitmap, std::shared_ptr<HeldBitmap>> bitmap(
      m, "Bitmap",
      "Paper 2's backward reachable set of a plan, on samples of every border: a picture that can "
      "be queried, not a proof. See docs/verification.md.");
  add_grid(bitmap, [](const HeldBitmap& held) { return held.bitmap.grid(); });
  bitmap
      .def("query", &query, "states"_a,
           R"(Looks up states in the samples, in about a tenth of a microsecond each.

states  float64 [n, 3]: x_m, y_m, heading_rad

Returns int8 [n], codes of Sampled, from the samples around the state in which the flight
first meets a border.)")
      .def("reach_map", &reach_map, "heading_rad"_a,
           R"(What the samples show for a vehicle near every cell's middle, for one heading.

Returns int8 [ny, nx], the lowest row first, codes of Sampled; REACH in the region, OTHER in
an obstacle. The states are those of Certificate.verdict_map.)")
      .def("border", &border, "ix"_a, "iy"_a, "side"_a,
           R"(The samples of the border of cell (ix, iy) on its `side`.

side  "right", "top", "left" or "bottom"; a cell must lie beyond it, else IndexError

Returns uint8 [samples, samples], by heading (the middles of equal sectors, counter-clockwise
from east) and place (the middles of equal pieces, upwards or to the right): 1 reaches.)")
      .def_property_readonly("words", &words,
                             "uint64 [borders, words]: all bits, as the file has them "
                             "(docs/formats.md); a read-only view.")
      .def_property_readonly(
          "samples", [](const HeldBitmap& held) { return held.bitmap.set.samples; },
          "Number of places and of headings sampled on each border.")
      .def_property_readonly(
          "summary",
          [](const HeldBitmap& held) {
            return python_of(nlohmann::json::parse(record_text(held.bitmap)));
          },
          "Its full record, a dict (docs/formats.md): the estimated share that reaches, "
          "options, digests of the plan.")
      .def("picture", &picture, py::kw_only(), "headings"_a = ReachabilityMapOptions{}.headings,
           "title"_a = "",
           "A Picture with one panel for each of `headings` headings: paper 2's reachability map, "
           "Fig. 23a, in slices.")
      .def("shares_picture", &shares_picture, py::kw_only(), "title"_a = "",
           "A Picture of the shares of headings that reach, that do not, and about which samples "
           "disagree, per cell.")
      .def(
          "save",
          [](const HeldBitmap& held, const std::filesystem::path& path, bool force) {
            const py::gil_scoped_release unlocked;
            write_bitmap(held.bitmap, path, force ? Existing::replace : Existing::keep);
          },
          "path"_a, py::kw_only(), "force"_a = false,
          "Writes a bitmap file (safetensors), whole or not at all. Raises ValueError if the file "
          "exists, unless `force`.")
      .def("save_geotiff", &save_geotiff, "path"_a, "headings_rad"_a = py::none(), py::kw_only(),
           "force"_a = false,
           "reach_map() of each heading (default: eight, evenly spaced) as the bands of a GeoTIFF, "
           "georeferenced if the map was (docs/exchange.md).")
      .def("__repr__", [](const HeldBitmap& held) {
        return fmt::format("<fairway.Bitmap: {}, {} samples a border>",
                           words_of(held.bitmap.grid()), held.bitmap.set.samples);
      });

  m.def("draw_bitmap", &draw, "plan"_a, py::kw_only(), "region"_a = "goal",
        "samples"_a = usual_border_samples, "seed"_a = 1,
        R"(Paper 2's method: which samples of the borders of `plan` reach a region.

region   region to be reached, as for verify()
samples  number of places and of headings on each border, a multiple of four
seed     random seed for the states that measure the share that reaches

Returns a Bitmap. Raises ValueError when the plan's cells are not smaller than its turning
radius.)");

  m.def(
      "load_bitmap",
      [](const std::filesystem::path& path) {
        const py::gil_scoped_release unlocked;
        return std::make_shared<HeldBitmap>(HeldBitmap{read_bitmap(path)});
      },
      "path"_a,
      "Reads a bitmap file, strictly. Raises InputError (a ValueError) naming the field that is "
      "wrong.");
}

}  // namespace fairway::python
