#include "systems/portrait/train/portrait_system.h"

#include "export/run_export.h"
#include "systems/portrait/portrait_options.h"
#include "systems/portrait/train/system.h"
#include "tests/support/expect_error.h"
#include "tests/systems/portrait/train/small_portrait_runs.h"

namespace daumier::portrait {
namespace {

TEST(PortraitTraining, IsARowOfTheTrainingLibrary) {
  const systems::SystemTraining row = PortraitTraining();
  EXPECT_EQ(row.name, kPortraitSystem);
  EXPECT_EQ(row.validation_metric, "vertex_error_mm");
  EXPECT_EQ(PortraitTrainings().back().name, kPortraitSystem);
  EXPECT_GT(row.infer_ms(testing::SmallPortraitRun()), 0);
  EXPECT_EQ(row.describe_export(testing::SmallPortraitRun()).function.name, "portrait");
}

TEST(PortraitTraining, EvaluatesByOptionsInJson) {
  const systems::SystemTraining row = PortraitTraining();
  FolderCache databases;
  const reports::Evaluation evaluation = row.evaluate(
      testing::SmallPortraitRun(), {{"max_images", 1}, {"refined_images", 0}, {"baselines", false}}, databases, {});
  EXPECT_EQ(evaluation.table.rows.size(), 1U);
  EXPECT_EQ(evaluation.metrics.at("num_images"), 1);
  testing::ExpectError(
      [&] {
        row.evaluate(testing::SmallPortraitRun(), {{"max_faces", 1}}, databases, {});
      },
      "max_faces");
}

}  // namespace
}  // namespace daumier::portrait
