#include "systems/portrait/picture_hair.h"

#include "core/picture_parts.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::portrait {
namespace {

/// Brows at (100, 100), chin at (100, 200): v is (100 - y) / 100, u is (x - 100) / 100.
std::vector<float> Landmarks() {
  std::vector<float> landmarks(136, 100);
  landmarks[2 * 8 + 1] = 200;
  return landmarks;
}

struct HairBox {
  int left, top, right, bottom;
};

/// A mask of 200 x 300 whose boxes are hair, and its picture: hair red, else white.
struct Shown {
  render::Image picture{300, 200, 3}, mask{300, 200, 1, uint8_t(PictureClass::kSkin)};

  explicit Shown(const std::vector<HairBox>& boxes) {
    for (const HairBox& box : boxes) {
      for (int row = box.top; row < box.bottom; ++row) {
        for (int column = box.left; column < box.right; ++column) {
          mask.at(row, column) = uint8_t(PictureClass::kHair);
          picture.at(row, column, 0) = 160;
          picture.at(row, column, 1) = 40;
          picture.at(row, column, 2) = 20;
        }
      }
    }
  }
};

faces::HairStyle StyleOf(const std::vector<HairBox>& boxes) {
  const Shown shown(boxes);
  return LooksOf(FindShownHair(shown.picture, shown.mask, Landmarks())).hair;
}

TEST(ShownHair, MeasuresTheBoxesOfAPicture) {
  const Shown shown({{40, 20, 160, 60}, {5, 60, 45, 180}});
  const ShownHair hair = FindShownHair(shown.picture, shown.mask, Landmarks());
  EXPECT_NEAR(hair.crown, 0.75, 0.03) << "v from 0.4 of 0.3 to 0.7";
  EXPECT_NEAR(hair.forehead, 0.4, 0.02);
  EXPECT_NEAR(hair.length, -0.8, 0.06);
  EXPECT_LT((255 * hair.colour - Eigen::Vector3f(160, 40, 20)).norm(), 1);
}

TEST(ShownHair, IsTheStyleOfItsLength) {
  EXPECT_EQ(StyleOf({}), faces::HairStyle::kBald);
  EXPECT_EQ(StyleOf({{40, 20, 160, 60}}), faces::HairStyle::kShort);
  EXPECT_EQ(StyleOf({{40, 20, 160, 95}}), faces::HairStyle::kFringe);
  EXPECT_EQ(StyleOf({{40, 20, 160, 60}, {5, 60, 45, 180}}), faces::HairStyle::kBob);
  EXPECT_EQ(StyleOf({{40, 20, 160, 60}, {155, 60, 195, 260}}), faces::HairStyle::kLong);
  // A collar of hair far below the head's is not its end.
  EXPECT_EQ(StyleOf({{40, 20, 160, 60}, {5, 60, 45, 90}, {5, 200, 45, 280}}), faces::HairStyle::kShort);
}

TEST(ShownHair, TurnsWithTheFace) {
  // The same landmarks and hair by a quarter turn: the chin to the left.
  const Shown shown({{40, 20, 160, 60}, {5, 60, 45, 180}});
  render::Image picture(200, 300, 3), mask(200, 300, 1);
  for (int row = 0; row < 300; ++row) {
    for (int column = 0; column < 200; ++column) {
      mask.at(column, 299 - row) = shown.mask.at(row, column);
      for (int c = 0; c < 3; ++c) picture.at(column, 299 - row, c) = shown.picture.at(row, column, c);
    }
  }
  std::vector<float> landmarks(136);
  for (size_t n = 0; n < 68; ++n) {
    landmarks[2 * n] = 300 - Landmarks()[2 * n + 1];
    landmarks[2 * n + 1] = Landmarks()[2 * n];
  }
  const ShownHair upright = FindShownHair(shown.picture, shown.mask, Landmarks());
  const ShownHair turned = FindShownHair(picture, mask, landmarks);
  EXPECT_NEAR(turned.crown, upright.crown, 0.03);
  EXPECT_NEAR(turned.length, upright.length, 1e-9);
}

TEST(ShownHair, RefusesAnotherMaskAndMissingLandmarks) {
  const Shown shown({});
  daumier::testing::ExpectError([&] { FindShownHair(shown.picture, render::Image(10, 10, 1), Landmarks()); },
                                "a mask of 10 x 10");
  daumier::testing::ExpectError([&] { FindShownHair(shown.picture, shown.mask, std::vector<float>(4)); }, "68");
}

}  // namespace
}  // namespace daumier::portrait
