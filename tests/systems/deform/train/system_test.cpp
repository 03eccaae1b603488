#include "systems/deform/train/system.h"

#include "systems/deform/run_folder.h"
#include "systems/deform/system.h"

#include <gtest/gtest.h>

namespace daumier::deform {
namespace {

TEST(DeformTraining, HasTheNameOfItsSystem) {
  EXPECT_EQ(DeformTraining().name, kSystem);
  EXPECT_EQ(DeformTraining().name, DeformSystem().name);
}

TEST(DeformTraining, TrainsEvaluatesAndExports) {
  const systems::SystemTraining row = DeformTraining();
  EXPECT_NE(row.train, nullptr);
  EXPECT_TRUE(row.evaluate != nullptr || row.evaluate_into != nullptr);
  EXPECT_NE(row.describe_export, nullptr);
  EXPECT_EQ(row.validation_metric, "mean_vertex_error_mm");
  EXPECT_EQ(row.training_metric, "training_error_mm");
}

}  // namespace
}  // namespace daumier::deform
