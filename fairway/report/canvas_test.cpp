#include "fairway/report/canvas.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "fairway/base/error.hpp"
#include "fairway/base/heading.hpp"
#include "fairway/report/hatch.hpp"
#include "fairway/report/testing/reading_pictures.hpp"

namespace fairway {
namespace {

using testing::read_png;
using testing::read_svg;

Picture some_picture() {
  Canvas canvas(50.0, 40.0, 2.0, "some <picture> & more");
  {
    const auto layer = canvas.layer("shapes", Rect{5.0, 5.0, 30.0, 30.0});
    canvas.fill(Rect{10.0, 10.0, 10.0, 10.0}.outline(), {200, 0, 0});
    canvas.stroke(DrawingPath::circle({20.0, 20.0}, 8.0), {{0, 0, 200}, 1.0, {2.0, 1.0}});
    canvas.text("text", {12.0, 30.0});
  }
  canvas.image({2, 1, {{1, 2, 3}, {4, 5, 6}}}, {36.0, 0.0, 8.0, 4.0});
  return canvas.finish();
}

TEST(Canvas, TheSamePictureHasTheSameBytesWhateverWasDrawnBefore) {
  const Picture first = some_picture();
  { Canvas(10.0, 10.0, 1.0, "another").text("x", {1.0, 5.0}); }
  const Picture second = some_picture();
  EXPECT_EQ(first.svg, second.svg);
  EXPECT_EQ(first.png, second.png);
}

TEST(Canvas, BothFormatsHaveTheSizeAskedFor) {
  const Picture picture = some_picture();
  const auto root = read_svg(picture.svg).front();
  EXPECT_EQ(root.attributes.at("viewBox"), "0 0 50 40");
  EXPECT_EQ(root.attributes.at("width"), "50pt");
  const auto png = read_png(picture.png);
  EXPECT_EQ(png.width, 100);
  EXPECT_EQ(png.height, 80);
}

TEST(Canvas, FillsClipsAndImagesLandWhereTheyShould) {
  const auto png = read_png(some_picture().png);
  EXPECT_EQ(png.at(30, 30), (Color{200, 0, 0}));
  EXPECT_EQ(png.at(2, 2), palette::white);
  EXPECT_EQ(png.at(72 + 4, 4), (Color{1, 2, 3}));
  EXPECT_EQ(png.at(72 + 12, 4), (Color{4, 5, 6}));

  Canvas canvas(20.0, 20.0, 1.0, "");
  {
    const auto layer = canvas.layer("half", Rect{0.0, 0.0, 10.0, 20.0});
    canvas.fill(Rect{0.0, 0.0, 20.0, 20.0}.outline(), {9, 9, 9});
  }
  const auto clipped = read_png(canvas.finish().png);
  EXPECT_EQ(clipped.at(5, 5), (Color{9, 9, 9}));
  EXPECT_EQ(clipped.at(15, 5), palette::white);
}

RC_GTEST_PROP(Canvas, AnyBytesInTitlesAndTextsGiveWellFormedSvgAndAPicture,
              (const std::string& bytes)) {
  Canvas canvas(60.0, 30.0, 1.0, bytes);
  canvas.text(bytes, {5.0, 20.0});
  const Picture picture = canvas.finish();
  RC_ASSERT(!read_svg(picture.svg).empty());
  RC_ASSERT(read_png(picture.png).width == 60);
}

TEST(Canvas, ReadableTextsStayAsTheyAre) {
  for (const std::string text : {"a < b & c > \"d\"", "Grüße aus Zürich", "λ = 3 → 4", "😀"}) {
    Canvas canvas(60.0, 30.0, 1.0, "");
    canvas.text(text, {5.0, 20.0});
    EXPECT_TRUE(testing::has_text(canvas.finish().svg, text)) << text;
  }
  Canvas canvas(60.0, 30.0, 1.0, "");
  canvas.text(std::string("a\xff\x01z\xed\xa0\x80", 7), {5.0, 20.0});
  EXPECT_TRUE(testing::has_text(canvas.finish().svg, "a??z???"));
}

TEST(Canvas, ArcsStayArcsInTheSvgAndEndWhereTheyShould) {
  Canvas canvas(100.0, 100.0, 1.0, "");
  DrawingPath path;
  path.move_to({60.0, 50.0}).arc({50.0, 50.0}, 10.0, 0.0, -1.5 * pi);
  canvas.stroke(path, {});
  const auto elements = read_svg(canvas.finish().svg);
  const std::string data = elements.back().attributes.at("d");
  EXPECT_THAT(data, ::testing::HasSubstr("A10 10 0 0 0"));  // sweeps against the clock on the page
  EXPECT_THAT(data, ::testing::EndsWith("50 60"));
}

TEST(Canvas, AFullCircleIsDrawnInFull) {
  Canvas canvas(40.0, 40.0, 2.0, "");
  canvas.stroke(DrawingPath::circle({20.0, 20.0}, 10.0), {{0, 0, 0}, 2.0, {}});
  const Picture picture = canvas.finish();
  const auto png = read_png(picture.png);
  for (double a = 0.1; a < two_pi; a += 0.3)
    EXPECT_LT(png.at(40.0 + 20.0 * std::cos(a), 40.0 + 20.0 * std::sin(a)).red, 60) << a;
  const std::string data = read_svg(picture.svg).back().attributes.at("d");
  EXPECT_EQ(std::count(data.begin(), data.end(), 'A'), 3);
}

TEST(Canvas, CallerMistakesAreReported) {
  EXPECT_THROW(Canvas(0.0, 10.0, 1.0, ""), PreconditionViolation);
  EXPECT_THROW(Canvas(10.0, 1e9, 1.0, ""), PreconditionViolation);
  Canvas canvas(10.0, 10.0, 1.0, "");
  EXPECT_THROW(canvas.image({2, 2, {palette::ink}}, {0.0, 0.0, 1.0, 1.0}), PreconditionViolation);
  const auto layer = canvas.layer("open");
  EXPECT_THROW(static_cast<void>(canvas.finish()), PreconditionViolation);
}

TEST(Canvas, LongerTextsAreWider) {
  EXPECT_EQ(text_width_pt(""), 0.0);
  EXPECT_GT(text_width_pt("wider"), text_width_pt("wide"));
  EXPECT_GT(text_width_pt("m", {.size_pt = 20.0}), 2.0 * text_width_pt("m", {.size_pt = 9.0}));
}

TEST(Hatch, StrokesStayInTheAreaAndFillIt) {
  const Rect area{0.0, 0.0, 40.0, 30.0};
  const auto covers = [](Vec2 p) { return norm(p - Vec2{20.0, 15.0}) < 9.0; };
  for (const bool rising : {false, true}) {
    const DrawingPath path = hatch(area, 3.0, rising, covers);
    double length = 0.0;
    Vec2 last;
    for (const auto& piece : path.pieces()) {
      EXPECT_TRUE(covers(piece.end));
      if (piece.kind == DrawingPath::Kind::line) {
        EXPECT_NEAR((piece.end.y - last.y) * (rising ? -1.0 : 1.0), piece.end.x - last.x, 1e-9);
        length += norm(piece.end - last);
      }
      last = piece.end;
    }
    EXPECT_NEAR(length, pi * 81.0 / 3.0, 0.15 * pi * 81.0 / 3.0);  // area / spacing
  }
  EXPECT_TRUE(hatch(area, 3.0, true, [](Vec2) { return false; }).empty());
}

}  // namespace
}  // namespace fairway
