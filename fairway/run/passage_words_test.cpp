#include "fairway/run/passage_words.hpp"

#include <gtest/gtest.h>

namespace fairway {
namespace {

CutOff with_passage() {
  CutOff cut;
  cut.free_cells = 1000;
  cut.cut_off_cells = 400;
  cut.passage = Passage{{12.0, -34.56}, 8.0, 10.0, 1.599, 1.998, 300};
  return cut;
}

TEST(PassageWords, NameThePlaceTheWidthAndWhatOpensIt) {
  const std::string words = passage_words(with_passage(), {});
  EXPECT_EQ(words,
            "The widest passage that is too narrow is at (12, -34.56): it is 8 m wide from "
            "obstacle cell to obstacle cell, but the buffers on both sides take 10 m; alpha = "
            "1.599 or turn_radius_m = 1.998 would open it for 75 % of the cells that are cut off.");
}

TEST(PassageWords, AreInDegreesTooWhereTheMapHasAPlaceOnEarth) {
  Frame frame;
  frame.geo = GeoReference{47.3977, 8.5456, 0.0};
  const std::string words = passage_words(with_passage(), frame);
  EXPECT_NE(words.find("(12, -34.56), latitude 47.39739 longitude 8.54576:"), std::string::npos)
      << words;
}

TEST(PassageWords, OfWallsSayThatNothingOpensThem) {
  CutOff cut = with_passage();
  cut.walled_off_cells = 100;
  EXPECT_TRUE(passage_words(cut, {}).ends_with(
      " Walls without a gap enclose 25 % of the cells that are cut off: no alpha or turning "
      "radius opens a way."));
  cut.passage.reset();
  EXPECT_TRUE(passage_words(cut, {}).starts_with("Walls without a gap enclose 25 %"));
  EXPECT_EQ(passage_words({}, {}), "");
}

}  // namespace
}  // namespace fairway
