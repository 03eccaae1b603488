#include "systems/portrait/train/portrait_system.h"

#include "ablation/ablation.h"
#include "datasets/build/portrait_maker.h"
#include "export/run_export.h"
#include "systems/portrait/portrait_metrics.h"
#include "systems/portrait/portrait_options.h"
#include "systems/portrait/portrait_system.h"
#include "systems/portrait/train/system.h"
#include "tests/support/expect_error.h"
#include "tests/support/paths.h"
#include "tests/systems/portrait/train/small_portrait_runs.h"

#include <algorithm>
#include <set>

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

TEST(PortraitAblation, EachRowOfTheTableResolvesAndNamesWhatIsThere) {
  const ablation::Ablation ablation =
      ablation::LoadAblation(daumier::testing::SourceRoot() / "configs/portrait/ablation_cpu.toml",
                             {"data.faces=faces", "data.portraits=portraits", "source.path=source"}, {});
  const systems::System system = PortraitSystem();
  const systems::SystemTraining training = PortraitTraining();
  const auto steps = ablation::PlanAblation(ablation, {system, training}, "absent");
  EXPECT_EQ(steps.size(), ablation.rows.size());
  std::vector<std::string> styles = datasets::PortraitMaker::StyleNames();
  styles.emplace_back(kBaldStyle);
  const std::set<std::string> lines = {kPortraitNetworkRow, kRefinedRow, kMeanFaceRow, kLandmarkFitRow};
  int num_trained = 0;
  for (const ablation::AblationRow& row : ablation.rows) {
    if (!row.options.line.empty()) {
      EXPECT_TRUE(lines.contains(row.options.line)) << row.name();
      const ablation::AblationRow& source = ablation.row(row.options.from, row.name());
      if (row.options.line == kRefinedRow) {
        EXPECT_GT(source.eval.at("refined_images").get<int>(), 0);
      } else {
        EXPECT_TRUE(source.eval.at("baselines").get<bool>());
      }
    }
    if (!row.trains()) continue;
    ++num_trained;
    const auto options =
        ParseOptions<PortraitTrainingOptions>(system.resolve_config(row.config, row.name()), row.name());
    EXPECT_EQ(options.trainer.epochs, 12) << row.name();
    for (const std::string& style : options.pictures.leave_out)
      EXPECT_EQ(std::ranges::count(styles, style), 1) << row.name() << ": " << style;
  }
  EXPECT_EQ(num_trained, 5);
}

TEST(PortraitAblation, WithoutCartoonStylesLeavesPicturesThatAreShadedSmoothly) {
  const ablation::Ablation ablation = ablation::LoadAblation(
      daumier::testing::SourceRoot() / "configs/portrait/ablation_cpu.toml", {"source.path=source"}, {});
  const Json& config = ablation.row("without cartoon styles", "the test").config;
  const auto unwanted = config.at("pictures").at("leave_out").get<std::set<std::string>>();
  std::vector<std::string> left;
  for (const std::string& style : datasets::PortraitMaker::StyleNames())
    if (!unwanted.contains(style)) left.push_back(style);
  EXPECT_EQ(left, (std::vector<std::string>{"smooth", "smooth_grey"}));
}

}  // namespace
}  // namespace daumier::portrait
