// What is to be reached, from words and files to cells, and certificates of it.
#include "fairway/run/region_request.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/bitmap/bitmap_file.hpp"
#include "fairway/certificate/certificate_file.hpp"
#include "fairway/certificate/proof_identity.hpp"
#include "fairway/map/testing/scratch_folder.hpp"
#include "fairway/run/bitmap_verification.hpp"
#include "fairway/run/verification.hpp"
#include "fairway/verify/testing/plans_to_verify.hpp"

namespace fairway {
namespace {

using Kind = RegionOfInterest::Kind;

TEST(RegionRequest, IsAWordARectangleOrAFile) {
  EXPECT_EQ(region_request_of("goal")->kind, Kind::goal);
  EXPECT_EQ(region_request_of("obstacle")->kind, Kind::obstacle);
  const auto box = region_request_of("-1.5,2,3e1,40");
  ASSERT_TRUE(box);
  EXPECT_EQ(box->kind, Kind::rectangle);
  EXPECT_EQ(box->rectangle_m, (std::array{-1.5, 2.0, 30.0, 40.0}));
  const auto file = region_request_of("north,west.geojson");
  ASSERT_TRUE(file);
  EXPECT_EQ(file->kind, Kind::cells);
  EXPECT_EQ(file->file, "north,west.geojson");
  for (const char* none :
       {"", "1", "1,2,3", "1,2,3,4,5", "3,0,1,4", "0,3,1,3", "0,0,inf,1", "nan,0,1,1"}) {
    EXPECT_FALSE(region_request_of(none)) << none;
  }
}

/// A rectangle of cells of the plan's grid, as a text for both ways.
struct Box {
  Vec2 low;
  Vec2 high;

  std::string polygon() const {
    const auto at = [](double x, double y) { return fmt::format("[{},{}]", x, y); };
    return R"({"type":"Polygon","coordinates":[[)" + at(low.x, low.y) + "," + at(high.x, low.y) +
           "," + at(high.x, high.y) + "," + at(low.x, high.y) + "," + at(low.x, low.y) + "]]}";
  }
  RegionOfInterest rectangle() const {
    return {Kind::rectangle, {low.x, low.y, high.x, high.y}, {}};
  }
};

Box box_on(const Grid& grid) { return {grid.corner({2, 2}), grid.corner({7, 6})}; }

RegionOfInterest by_polygon(const Plan& plan) {
  const ScratchFolder folder;
  const auto file = folder.write("area.geojson", box_on(plan.grid).polygon());
  return region_on_plan({Kind::cells, {}, file}, plan);
}

TEST(RegionRequest, ByPolygonIsProvedAsTheRectangleWhoseCellsItHas) {
  const Plan plan = random_plan(11);
  CertifyOptions options;
  options.samples = 1000;
  options.last_level = 6;
  const RegionOfInterest cells = by_polygon(plan);
  const RegionOfInterest rectangle = box_on(plan.grid).rectangle();
  const Certificate a = verify_plan(plan, "p", cells, options).certificate;
  const Certificate b = verify_plan(plan, "p", rectangle, options).certificate;
  EXPECT_EQ(a.kind, b.kind);
  EXPECT_EQ(a.sections.first, b.sections.first);
  EXPECT_EQ(a.sections.begin, b.sections.begin);
  EXPECT_EQ(a.sections.rank, b.sections.rank);
  EXPECT_EQ(a.sections.time_s, b.sections.time_s);
  EXPECT_EQ(a.sections.verdict, b.sections.verdict);
  EXPECT_EQ(a.evidence_json, b.evidence_json);
  EXPECT_NE(proof_identity(a), proof_identity(b));  // what was asked is not the same
}

TEST(RegionRequest, ByPolygonGivesTheBitmapOfTheRectangleWhoseCellsItHas) {
  const Plan plan = random_plan(11);
  const Bitmap a = draw_bitmap(plan, "p", by_polygon(plan), 8, 1).bitmap;
  const Bitmap b = draw_bitmap(plan, "p", box_on(plan.grid).rectangle(), 8, 1).bitmap;
  EXPECT_EQ(a.set, b.set);
  EXPECT_EQ(a.kind, b.kind);
}

TEST(RegionOfCells, IsPartOfWhatWasProvedAndReadsBack) {
  const Plan plan = random_plan(11);
  CertifyOptions options;
  options.samples = 1000;
  options.last_level = 4;
  const Certificate made = verify_plan(plan, "p", by_polygon(plan), options).certificate;
  const ScratchFolder folder;
  write_certificate(made, folder.file("c"), Existing::keep);
  const Certificate back = read_certificate(folder.file("c"));
  EXPECT_EQ(back.region_of_interest.kind, Kind::cells);
  EXPECT_EQ(back.kind, made.kind);
  EXPECT_EQ(proof_identity(back), proof_identity(made));
  RegionOfInterest other = by_polygon(plan);
  EXPECT_EQ(proof_identity(plan, other), proof_identity(made));
  for (std::size_t i = 0; i < other.cells.size(); ++i) {  // obstacles are never part of it
    if (plan.region[i] == Region::obstacle) other.cells[i] = 1;
  }
  EXPECT_EQ(proof_identity(plan, other), proof_identity(made));
  for (std::size_t i = 0; i < other.cells.size(); ++i) {
    if (plan.region[i] == Region::obstacle) continue;
    other.cells[i] ^= 1;
    EXPECT_NE(proof_identity(plan, other), proof_identity(made));
    break;
  }
}

TEST(RegionOfCells, OfAnotherGridIsOfNoProofAboutThisOne) {
  const Plan plan = random_plan(11);
  RegionOfInterest other = by_polygon(plan);
  other.cells.push_back(0);
  EXPECT_NE(proof_identity(plan, other), proof_identity(plan, by_polygon(plan)));
}

TEST(RegionOfCells, OfNothingButObstaclesIsRefused) {
  Plan plan = random_plan(11);
  plan.region[5] = Region::obstacle;
  std::vector<std::uint8_t> cells(plan.grid.size());
  cells[5] = 1;
  EXPECT_THROW((void)region_of_cells(cells, plan, "mask"), InputError);
  plan.region[5] = Region::free;
  EXPECT_EQ(region_of_cells(cells, plan, "mask").cells, cells);
}

}  // namespace
}  // namespace fairway
