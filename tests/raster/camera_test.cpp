#include "raster/camera.h"

#include "tests/raster/small_mesh.h"

#include <gtest/gtest.h>

namespace daumier::raster {
namespace {

TEST(Project, InPerspectiveIsThatOfTheFormula) {
  const std::vector<double> point = {1, 2, 20};
  std::vector<double> at(4);
  Project(Camera{}, 1, point.data(), at.data());
  EXPECT_DOUBLE_EQ(at[3], 80);
  EXPECT_DOUBLE_EQ(at[0] / at[3], 112 + 1015.0 / 80);
  EXPECT_DOUBLE_EQ(at[1] / at[3], 112 - 2 * 1015.0 / 80);
  EXPECT_DOUBLE_EQ(at[2], 1015 * (80.0 - 100));
}

TEST(Project, OrthographicIsThatOfTheFormulaAndAPixelOfDepthIsAPixel) {
  const Camera camera = {.projection = Camera::Projection::kOrthographic, .focal = 6, .centre_x = 50, .centre_y = 40};
  const std::vector<double> point = {1, 2, 3};
  std::vector<double> at(4);
  Project(camera, 1, point.data(), at.data());
  EXPECT_EQ(at, (std::vector<double>{56, 28, -18, 1}));
}

TEST(Project, DepthInPerspectiveIsAboutAPixelAtTheOrigin) {
  const std::vector<double> points = {0, 0, 0.01, 0, 0, -0.01};
  std::vector<double> at(8);
  Project(Camera{}, 2, points.data(), at.data());
  const double per_cm = (at[6] / at[7] - at[2] / at[3]) / 0.02;
  EXPECT_NEAR(per_cm, 1015.0 / 100, 1e-4);
}

TEST(Project, GradientEqualsCentralDifferences) {
  for (const auto projection : {Camera::Projection::kPerspective, Camera::Projection::kOrthographic}) {
    const Camera camera = {.projection = projection, .focal = 50, .centre_x = 3, .centre_y = 4, .distance = 9};
    const auto points = RandomNumbers<double>(15, 1);
    auto weights = RandomNumbers<double>(20, 2);
    std::vector<double> gradient(15);
    ProjectBackward(camera, 5, weights.data(), gradient.data());
    for (size_t i = 2; i < weights.size(); i += 4) weights[i] = 0;  // Depth carries no gradient.
    const auto sum = [&](const std::vector<double>& x) {
      std::vector<double> at(20);
      Project(camera, 5, x.data(), at.data());
      return Dot(at, weights);
    };
    EXPECT_LT(MaxDifference(sum, points, gradient), 1e-7);
  }
}

}  // namespace
}  // namespace daumier::raster
