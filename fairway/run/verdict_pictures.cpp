#include "fairway/run/verdict_pictures.hpp"

#include <utility>

#include "fairway/base/atomic_file.hpp"
#include "fairway/report/draw_flights.hpp"
#include "fairway/report/draw_modes.hpp"
#include "fairway/report/draw_verdicts.hpp"
#include "fairway/verify/sample_verdicts.hpp"

namespace fairway {
namespace {

void write(const Picture& picture, const std::filesystem::path& folder, const std::string& name) {
  write_whole(folder / (name + ".svg"), Existing::keep, picture.svg);
  write_whole(folder / (name + ".png"), Existing::keep, picture.png);
}

std::string titled(const std::string& title, const char* what) {
  return title.empty() ? what : title + ": " + what;
}

}  // namespace

Plan as_verified(Plan plan, const Certificate& certificate) {
  return as_verified(std::move(plan), certificate.kind);
}

Plan as_verified(Plan plan, const std::vector<CellKind>& kind) {
  for (std::size_t i = 0; i < plan.region.size(); ++i) {
    if (kind[i] == CellKind::target) {
      plan.region[i] = Region::goal;
    } else if (plan.region[i] == Region::goal) {
      plan.region[i] = Region::free;
    }
  }
  return plan;
}

std::vector<std::string> verdict_picture_files() {
  return {"verdicts.svg", "verdicts.png", "proved.svg",          "proved.png",
          "modes.svg",    "modes.png",    "counterexamples.svg", "counterexamples.png"};
}

void write_verdict_pictures(const Plan& plan, const Certificate& certificate,
                            std::span<const Flight> counterexamples, std::uint64_t seed,
                            const std::string& title, const std::filesystem::path& folder) {
  VerdictMapOptions sampled;
  sampled.seed = seed;
  const VerdictMap map = verdict_map_of(certificate.view(), sampled);
  write(draw_verdicts(map, {.title = titled(title, "verdicts near the cells' middles")}), folder,
        "verdicts");
  write(draw_proved_shares(map, {.title = titled(title, "verdicts over all headings")}), folder,
        "proved");
  if (map.modes > 1) {
    const auto looks = mode_looks(map.modes, plan.record.modes);
    write(draw_modes(map, looks, {.title = titled(title, "modes that are proved to reach")}),
          folder, "modes");
  }
  if (counterexamples.empty()) return;
  write(
      draw_flights(
          plan, counterexamples,
          {.title = titled(title, "a flight to each kind of failure"), .mission = {}, .names = {}}),
      folder, "counterexamples");
}

}  // namespace fairway
