#include "datasets/read/curve_coefficients.h"

#include "datasets/read/training_fit.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_database.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::datasets {
namespace {

class GivenShapeTest : public ::testing::Test {
 protected:
  GivenShapeTest() {
    testing::BuildSyntheticFaces(folder_ / "faces");
    testing::BuildSyntheticSketches(folder_ / "faces", folder_ / "sketches");
    const faces::FaceDatabase faces(folder_ / "faces");
    sketches_.emplace(folder_ / "sketches");
    const Split split = MakeSplit(faces, {}, 2);
    curves_ = FitCurvesOnTraining(faces, *sketches_, split, {.num_identity = 6, .num_expression = 3}).model;
    encoder_.emplace(curves_);
  }

  const testing::TempDir folder_;
  std::optional<SketchDatabase> sketches_;
  faces::BilinearModel curves_;
  std::optional<faces::CurveEncoder> encoder_;
};

TEST_F(GivenShapeTest, IsTheEncodingOfTheFeatureCurvesPoints) {
  const auto strokes = sketches_->strokes(3);
  const auto points = PointsOf(strokes, sketches_->feature_curves());
  const std::vector<float> ones(points.size() / 2, 1.0f);
  const auto code = GivenShape(*encoder_, *sketches_, strokes);
  EXPECT_EQ(code.numbers(), encoder_->Encode(points, ones).numbers());
  EXPECT_EQ(code.numbers().size(), encoder_->num_numbers());
}

TEST_F(GivenShapeTest, DoesNotLookAtWhatTheSketchDoesNotShow) {
  auto strokes = sketches_->strokes(3);
  std::vector<std::vector<bool>> visible;
  for (const auto& stroke : strokes) visible.emplace_back(stroke.points.size(), true);
  const auto curve = size_t(sketches_->feature_curves()[0]);
  visible[curve].assign(visible[curve].size(), false);
  const auto hidden = GivenShape(*encoder_, *sketches_, strokes, visible);
  for (auto& point : strokes[curve].points) point = {1e4f, -1e4f};
  EXPECT_EQ(GivenShape(*encoder_, *sketches_, strokes, visible).numbers(), hidden.numbers());
  EXPECT_NE(GivenShape(*encoder_, *sketches_, strokes).numbers(), hidden.numbers());
}

TEST_F(GivenShapeTest, PointWeightsAreOneForWhatIsShown) {
  const auto strokes = sketches_->strokes(3);
  std::vector<std::vector<bool>> visible;
  for (const auto& stroke : strokes) visible.emplace_back(stroke.points.size(), true);
  const auto curve = size_t(sketches_->feature_curves()[0]);
  visible[curve][1] = false;
  const auto weights = PointWeights(*sketches_, strokes, visible);
  EXPECT_EQ(2 * weights.size(), PointsOf(strokes, sketches_->feature_curves()).size());
  for (size_t k = 0; k < weights.size(); ++k) EXPECT_EQ(weights[k], k == 1 ? 0.0f : 1.0f);
  EXPECT_EQ(PointWeights(*sketches_, strokes, {})[1], 1.0f);
}

}  // namespace
}  // namespace daumier::datasets
