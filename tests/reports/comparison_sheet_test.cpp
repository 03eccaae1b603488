#include "reports/comparison_sheet.h"

#include "render/heat_map.h"
#include "reports/face_pictures.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_face.h"

#include <gtest/gtest.h>

#include <limits>

namespace daumier::reports {
namespace {

/// A face with predictions whose error is everywhere the same.
ComparedFace MakeFace(const faces::FaceTemplate& face_template, const std::vector<double>& errors_mm) {
  ComparedFace face{
      .title = "median", .sketch = render::Image(64, 64, 1, 200), .truth = face_template.neutral, .predictions = {}};
  for (const double error : errors_mm)
    face.predictions.push_back(
        {face_template.neutral, Eigen::VectorXd::Constant(face_template.num_vertices(), error), error});
  return face;
}

/// Whether a colour is somewhere in columns [left, right) of a picture.
bool Has(const render::Image& image, const render::Rgb& colour, int left, int right) {
  for (int row = 0; row < image.height; ++row) {
    for (int column = left; column < right; ++column) {
      if (image.at(row, column, 0) == colour[0] && image.at(row, column, 1) == colour[1] &&
          image.at(row, column, 2) == colour[2])
        return true;
    }
  }
  return false;
}

TEST(ComparisonSheet, HasARowAFaceAndAColumnAPredictorAndOneBar) {
  const faces::FaceTemplate face_template = testing::SyntheticFace();
  const ComparedFace face = MakeFace(face_template, {1, 3});
  const render::Image one = ComparisonSheet(SurfaceOf(face_template), {"a", "b"}, {face});
  const render::Image two = ComparisonSheet(SurfaceOf(face_template), {"a", "b"}, {face, face});
  EXPECT_EQ(one.width, two.width);
  EXPECT_GT(two.height - one.height, kCell);
  EXPECT_GT(one.width, 4 * kCell + render::kColourBarWidth);
  EXPECT_LT(one.width, 5 * kCell + render::kColourBarWidth);
}

TEST(ComparisonSheet, PredictorsShareTheColours) {
  const faces::FaceTemplate face_template = testing::SyntheticFace();
  const auto sheet = [&](double first, double second) {
    return ComparisonSheet(SurfaceOf(face_template), {"a", "b"}, {MakeFace(face_template, {first, second})}, 10);
  };
  EXPECT_EQ(sheet(2, 5), sheet(2, 5));
  EXPECT_NE(sheet(2, 5), sheet(2, 2));
  // At its end and beyond, a colour stays the same; but the error below shows the difference.
  ComparedFace far = MakeFace(face_template, {20, 30});
  for (ComparedPrediction& prediction : far.predictions) prediction.mean_error_mm = 25;
  ComparedFace farther = far;
  farther.predictions[1].error_mm *= 2;
  EXPECT_EQ(ComparisonSheet(SurfaceOf(face_template), {"a", "b"}, {far}, 10),
            ComparisonSheet(SurfaceOf(face_template), {"a", "b"}, {farther}, 10));
}

TEST(ComparisonSheet, AnInputThatIsNoPictureLeavesItsPlaceFree) {
  const faces::FaceTemplate face_template = testing::SyntheticFace();
  ComparedFace face = MakeFace(face_template, {1});
  EXPECT_TRUE(Has(ComparisonSheet(SurfaceOf(face_template), {"a"}, {face}), {200, 200, 200}, 0, kCell));
  face.sketch = {};
  EXPECT_FALSE(Has(ComparisonSheet(SurfaceOf(face_template), {"a"}, {face}), {200, 200, 200}, 0, kCell));
}

TEST(ComparisonSheet, RefusesWhatDoesNotFit) {
  const faces::FaceTemplate face_template = testing::SyntheticFace();
  testing::ExpectError([&] { ComparisonSheet(SurfaceOf(face_template), {"a"}, {}); }, "1 predictors on 0 faces");
  testing::ExpectError(
      [&] {
        ComparisonSheet(SurfaceOf(face_template), {"a", "b"}, {MakeFace(face_template, {1})});
      },
      "1 predictions for 2 predictors");
  ComparedFace face = MakeFace(face_template, {1});
  face.predictions[0].error_mm.conservativeResize(3);
  testing::ExpectError([&] { ComparisonSheet(SurfaceOf(face_template), {"a"}, {face}); }, "3 errors");
  face = MakeFace(face_template, {1});
  face.sketch = render::Image(4, 5, 1);
  testing::ExpectError([&] { ComparisonSheet(SurfaceOf(face_template), {"a"}, {face}); }, "4 x 5");
}

}  // namespace
}  // namespace daumier::reports
