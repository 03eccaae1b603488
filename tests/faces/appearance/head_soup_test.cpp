#include "faces/appearance/head_soup.h"

#include "tests/faces/appearance/soup_checks.h"

#include <gtest/gtest.h>

#include <numbers>

namespace daumier::faces {
namespace {

constexpr SoupKind kKind{PictureClass::kHair, PicturePart::kHair};

TEST(HeadSoup, TubesRingsAndEllipsoidsAreClosedAndWoundOutwards) {
  const Eigen::Vector3f red(1, 0, 0);
  HeadSoup tube = testing::EmptySoup();
  AddTube({{0, 0, 0}, {0, 0, 1}, {0, 0, 2}}, {1, 1, 1}, 64, red, kKind, tube);
  const PortraitHead cylinder = tube.Take();
  testing::ExpectClosedSoup(cylinder);
  EXPECT_NEAR(testing::VolumeOf(cylinder), 2 * std::numbers::pi, 0.02);

  HeadSoup ring = testing::EmptySoup();
  std::vector<geometry::Vector3> path;
  for (int k = 0; k < 64; ++k)
    path.emplace_back(3 * std::cos(k * std::numbers::pi / 32), 3 * std::sin(k * std::numbers::pi / 32), 0);
  AddRing(path, 0.5, 32, red, kKind, ring);
  const PortraitHead torus = ring.Take();
  testing::ExpectClosedSoup(torus);
  EXPECT_NEAR(testing::VolumeOf(torus), 2 * std::pow(std::numbers::pi, 2) * 3 * 0.25, 0.25);

  for (const double sign : {1.0, -1.0}) {
    HeadSoup ball = testing::EmptySoup();
    Eigen::Matrix3d axes = Eigen::Vector3d(1, 2, 3).asDiagonal();
    axes.col(0) *= sign;
    AddEllipsoid({5, 5, 5}, axes, 32, 64, red, red, kKind, ball);
    const PortraitHead ellipsoid = ball.Take();
    testing::ExpectClosedSoup(ellipsoid);
    EXPECT_NEAR(testing::VolumeOf(ellipsoid), 8 * std::numbers::pi, 0.2) << "also with left-handed axes";
  }
}

TEST(HeadSoup, KeepsWhatItBeginsWithAndClampsColours) {
  HeadSoup soup(geometry::Points::Ones(2, 3), Eigen::MatrixXf::Constant(2, 3, 1.5f));
  EXPECT_EQ(soup.AddVertex({1, 2, 3}, {-1, 0.5f, 2}), 2);
  soup.AddQuad(0, 1, 2, 0, kKind);
  const PortraitHead head = soup.Take();
  EXPECT_EQ(head.colours.row(0).maxCoeff(), 1);
  EXPECT_EQ(head.colours.row(2), Eigen::RowVector3f(0, 0.5f, 1));
  EXPECT_EQ(head.triangles.rows(), 2);
  EXPECT_EQ(head.classes, std::vector<uint8_t>(2, uint8_t(PictureClass::kHair)));
}

}  // namespace
}  // namespace daumier::faces
