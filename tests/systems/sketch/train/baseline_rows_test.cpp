#include "systems/sketch/train/baseline_rows.h"

#include "systems/sketch/metrics.h"
#include "tests/systems/sketch/train/run_fixture.h"

namespace daumier::sketch {
namespace {

using BaselineRowsTest = SketchRunFixture;

TEST_F(BaselineRowsTest, RowsOfTheFacesAreFlaggedAndThoseOfCurveCoefficientsAreNot) {
  const SketchRunData data = OpenSketchRunData(*folder_ / "run");
  const SketchTestSet test(data, {.split = "train"}, {});
  const BaselineRows baselines = MeasureBaselines(test, ShapeCodes(test, std::nullopt, true), 0);
  std::vector<std::string> flagged, others;
  for (const reports::MetricRow& row : baselines.rows) (row.baseline ? flagged : others).push_back(row.name);
  EXPECT_EQ(flagged, (std::vector<std::string>{kMeanFace, kNearestNeighbour, kRidge, kModelLimit}));
  EXPECT_EQ(others, std::vector<std::string>{"ridge on shape numbers"});
  EXPECT_EQ(baselines.rows.back().input, "given");
  EXPECT_GT(baselines.ridge_lambda, 0);
  EXPECT_GT(baselines.shape_error_px.at("given").get<double>(), 0);
  EXPECT_EQ(baselines.rows[1].error().mean, 0) << "a training face is its own nearest neighbour";
  EXPECT_LT(baselines.rows[3].error().mean, baselines.rows[0].error().mean);
}

TEST_F(BaselineRowsTest, OfAugmentedSketchesRegressionsReadOtherPoints) {
  const SketchRunData data = OpenSketchRunData(*folder_ / "run");
  const SketchTestSet plain(data, {}, {}), strong(data, {.strength = 1.5}, {});
  const BaselineRows a = MeasureBaselines(plain, ShapeCodes(plain, std::nullopt, true), 0),
                     b = MeasureBaselines(strong, ShapeCodes(strong, std::nullopt, true), 1.5);
  EXPECT_EQ(a.rows[0].face_errors, b.rows[0].face_errors) << "the mean face reads no sketch";
  EXPECT_NE(a.rows[2].face_errors, b.rows[2].face_errors);
}

}  // namespace
}  // namespace daumier::sketch
