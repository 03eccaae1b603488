#include "systems/sketch/shape_input.h"

#include "datasets/read/training_fit.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_database.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::sketch {
namespace {

class ShapeInputTest : public ::testing::Test {
 protected:
  ShapeInputTest() {
    testing::BuildSyntheticFaces(folder_ / "faces");
    testing::BuildSyntheticSketches(folder_ / "faces", folder_ / "sketches");
    faces_.emplace(folder_ / "faces");
    sketches_.emplace(folder_ / "sketches");
    split_ = datasets::MakeSplit(*faces_, {.kind = "person", .validation = 0.15, .test = 0.15}, 2);
    curves_ =
        datasets::FitCurvesOnTraining(*faces_, *sketches_, split_, {.num_identity = 6, .num_expression = 3}).model;
  }

  const testing::TempDir folder_;
  std::optional<faces::FaceDatabase> faces_;
  std::optional<datasets::SketchDatabase> sketches_;
  datasets::Split split_;
  faces::BilinearModel curves_;
};

TEST_F(ShapeInputTest, TheTrueFacesCurvesAreRecoveredLikeGivenOnes) {
  const ShapeInput input(curves_, *sketches_, faces_->face_template());
  for (const int face : split_.test) {
    const auto strokes = sketches_->strokes(face);
    const double given = input.ErrorPx(input.Given(strokes), strokes);
    EXPECT_LT(given, 3) << "six identities say little about a seventh";
    EXPECT_NEAR(input.ErrorPx(input.Recovered(faces_->vertices(face), strokes, {.snaps = 0}), strokes), given, 0.05)
        << "its projected curves are the strokes";
  }
}

TEST_F(ShapeInputTest, SnappingImprovesAWrongPrediction) {
  const ShapeInput input(curves_, *sketches_, faces_->face_template());
  double predicted = 0, recovered = 0;
  for (const int face : split_.test) {
    const auto strokes = sketches_->strokes(face);
    const auto wrong = faces_->vertices(split_.train.front());
    predicted += input.ErrorPx(input.Recovered(wrong, strokes, {.snaps = 0}), strokes);
    recovered += input.ErrorPx(input.Recovered(wrong, strokes, {.snaps = 3}), strokes);
  }
  EXPECT_LT(recovered, 0.9 * predicted);
}

TEST_F(ShapeInputTest, HiddenPointsAreIgnored) {
  const ShapeInput input(curves_, *sketches_, faces_->face_template());
  auto strokes = sketches_->strokes(split_.test.front());
  std::vector<std::vector<bool>> visible;
  for (const auto& stroke : strokes) visible.emplace_back(stroke.points.size(), true);
  const auto curve = size_t(sketches_->feature_curves()[1]);
  visible[curve].assign(visible[curve].size(), false);
  const auto before = input.Given(strokes, visible);
  for (auto& point : strokes[curve].points) point = {1e3f, -1e3f};
  EXPECT_EQ(before.numbers(), input.Given(strokes, visible).numbers());
}

TEST_F(ShapeInputTest, ATemplateWithoutTheCurvesIsRefused) {
  faces::FaceTemplate face_template = faces_->face_template();
  face_template.annotation.curves.clear();
  testing::ExpectError([&] { ShapeInput(curves_, *sketches_, face_template); }, "no curve");
}

}  // namespace
}  // namespace daumier::sketch
