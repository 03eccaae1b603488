#include "systems/sketch/train/measurement.h"

#include "eval/metrics.h"
#include "tests/systems/sketch/train/run_fixture.h"

#include <cmath>

namespace daumier::sketch {
namespace {

using SketchMeasurementTest = SketchRunFixture;

TEST_F(SketchMeasurementTest, ItsRegionsMakeUpTheFace) {
  const SketchRunData data = OpenSketchRunData(*folder_ / "run");
  SketchMeasurement measurement(data, {});
  measurement.Measure();
  const Eigen::VectorXd map = measurement.mean_error_map();
  const auto& regions = data.faces.face_template().annotation.regions;
  double sum = 0;
  for (const int vertex : regions.at("face")) sum += map[vertex];
  EXPECT_NEAR(sum / double(regions.at("face").size()), measurement.result().error_mm, 1e-9);
  EXPECT_EQ((map.array().isNaN()).count(), map.size() - Eigen::Index(regions.at("face").size()));
  const auto by_region = measurement.region_errors_mm();
  double least = 1e9, most = 0;
  for (const auto& [name, error] : by_region) least = std::min(least, error), most = std::max(most, error);
  EXPECT_EQ(by_region.size(), 4u);
  EXPECT_LE(least, measurement.result().error_mm);
  EXPECT_GE(most, measurement.result().error_mm);
}

TEST_F(SketchMeasurementTest, PredictionsAreWhatTheErrorsAreOf) {
  const SketchRunData data = OpenSketchRunData(*folder_ / "run");
  SketchMeasurement measurement(data, {.strength = 1});
  measurement.Measure();
  const int face = measurement.faces()[3];
  const eval::FaceRows prediction = measurement.PredictResult(std::span(&face, 1));
  const Eigen::VectorXd map = measurement.ErrorMap(prediction, face);
  double sum = 0;
  int count = 0;
  for (const double error : map) {
    if (!std::isnan(error)) sum += error, ++count;
  }
  EXPECT_NEAR(sum / count, measurement.errors_mm()[3], 1e-3);
}

}  // namespace
}  // namespace daumier::sketch
