#include "systems/sketch/train/system.h"

#include "systems/sketch/run_folder.h"
#include "systems/sketch/system.h"

#include <gtest/gtest.h>

namespace daumier::sketch {
namespace {

TEST(SketchTraining, HasTheNameOfItsSystem) {
  EXPECT_EQ(SketchTraining().name, kSystem);
  EXPECT_EQ(SketchTraining().name, SketchSystem().name);
}

TEST(SketchTraining, TrainsEvaluatesAndExports) {
  const systems::SystemTraining row = SketchTraining();
  EXPECT_NE(row.train, nullptr);
  EXPECT_TRUE(row.evaluate != nullptr || row.evaluate_into != nullptr);
  EXPECT_NE(row.describe_export, nullptr);
  EXPECT_EQ(row.validation_metric, "mean_vertex_error_mm");
}

}  // namespace
}  // namespace daumier::sketch
