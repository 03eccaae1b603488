#include "systems/portrait/landmark_search.h"

#include "systems/portrait/landmark_views.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::portrait {
namespace {

TEST(SearchSquares, CoverThePictureWithOverlap) {
  EXPECT_EQ(SearchSquares(300, 400, 128, 0).size(), 1u);
  EXPECT_EQ(SearchSquares(300, 400, 128, 0)[0].side, 400);
  const std::vector<CropFrame> squares = SearchSquares(400, 400, 128, 1);
  EXPECT_EQ(squares.size(), 9u);
  for (const double x : {1.0, 199.0, 200.0, 399.0}) {
    const bool covered = std::ranges::any_of(squares, [&](const CropFrame& square) {
      return std::abs(square.centre.x() - x) <= 100 && std::abs(square.centre.y() - 5) <= 100;
    });
    EXPECT_TRUE(covered);
  }
  EXPECT_LT(SearchSquares(50, 400, 128, 2).size(), 49u);  // A long picture: squares above and below are left out.
}

TEST(BoxesOfMap, UndoTheTargetsOfASearchMap) {
  const Box box{30, 44, 71, 99};
  const CropFrame frame{.centre = {200, 100}, .side = 256, .size = 128};
  const SearchTargets targets = MakeSearchTargets({&box, 1}, 128);
  std::vector<float> map;
  for (const float score : targets.score) map.push_back(10 * score - 6);
  map.insert(map.end(), targets.box.begin(), targets.box.end());
  const std::vector<FoundBox> found = BoxesOfMap(map, frame, 0.3);
  ASSERT_EQ(found.size(), 1u);
  const Eigen::Vector2d corner = frame.ToPicture({box.left, box.top});
  EXPECT_NEAR(found[0].box.left, corner.x(), 1e-3);
  EXPECT_NEAR(found[0].box.top, corner.y(), 1e-3);
  EXPECT_NEAR(found[0].box.width(), 2 * box.width(), 1e-3);
  EXPECT_GT(found[0].score, 0.9);
  testing::ExpectError([&] { BoxesOfMap({map.data(), 9}, frame, 0.3); }, "has 9 numbers, expected 1280");
}

TEST(BoxesOfMap, EqualNeighboursAreOneBox) {
  std::vector<float> map(5 * 256, 0);
  std::fill(map.begin(), map.begin() + 256, -9.0f);
  map[100] = map[101] = 3;
  EXPECT_EQ(BoxesOfMap(map, {.centre = {64, 64}, .side = 128, .size = 128}, 0.3).size(), 1u);
}

TEST(WithoutDoubles, KeepsTheHighestOfBoxesThatOverlap) {
  const std::vector<FoundBox> kept =
      WithoutDoubles({{{0, 0, 10, 10}, 0.5}, {{1, 0, 11, 10}, 0.9}, {{50, 50, 60, 60}, 0.2}});
  ASSERT_EQ(kept.size(), 2u);
  EXPECT_EQ(kept[0].score, 0.9);
  EXPECT_EQ(kept[1].score, 0.2);
}

}  // namespace
}  // namespace daumier::portrait
