#include "ablation/database_task.h"

#include "core/files.h"
#include "core/manifest.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_database.h"
#include "tests/support/temp_dir.h"
#include "train/run_folder.h"
#include "systems/sketch/train/ablation.h"

#include <gtest/gtest.h>

#include <thread>

namespace daumier::ablation {
namespace {

namespace fs = std::filesystem;

class ProbedAblation : public sketch::SketchAblation {
 public:
  using DatabaseAblation::MedianMs;
  mutable std::vector<bool> resumed = {};

 protected:
  void TrainRun(const Json&, const fs::path&, bool resume, const std::string&) const override {
    resumed.push_back(resume);
  }
};

TEST(DatabaseAblation, IsFinishedWhereTheManifestTellsTheBestEpochOfThatConfigAndData) {
  const testing::TempDir folder;
  testing::BuildSyntheticFaces(folder / "faces");
  const Json config = {{"epochs", 2}, {"data", {{"faces", (folder / "faces").string()}}}};
  Manifest manifest{.kind = "run", .verb = "train"};
  manifest.config = {{"epochs", 2}};
  manifest.details["data"] = {{"faces", DataHash(folder / "faces")}};
  const ProbedAblation task;
  task.Train(config, folder / "run");
  MakeDirectory(folder / "run");
  WriteManifest(folder / "run", manifest);
  EXPECT_FALSE(task.Finished(folder / "run", config));
  task.Train(config, folder / "run");
  EXPECT_EQ(task.resumed, (std::vector<bool>{false, true}));

  manifest.counts["best_epoch"] = 1;
  WriteManifest(folder / "run", manifest);
  EXPECT_TRUE(task.Finished(folder / "run", config));
  Json other = config;
  other["epochs"] = 3;
  testing::ExpectError([&] { task.Finished(folder / "run", other); }, "epochs is 2 there and 3 now");
}

TEST(DatabaseAblation, FindsLinesAndTellsTestFacesApart) {
  const ProbedAblation task;
  Json metrics = {{"table", {{{"name", "network"}}}},
                  {"num_faces", 2},
                  {"split", "test"},
                  {"faces", {3, 5}},
                  {"data_hash", {{"faces", "f"}}}};
  EXPECT_TRUE(task.HasLine(metrics, "network"));
  EXPECT_FALSE(task.HasLine(metrics, "mean face"));
  const std::string tested = task.TestedOn(metrics);
  EXPECT_EQ(task.TestedOn(metrics), tested);
  metrics["faces"] = {3, 6};
  EXPECT_NE(task.TestedOn(metrics), tested);
}

TEST(DatabaseAblation, TimesTheMedianOfManyCalls) {
  int calls = 0;
  const double ms = ProbedAblation::MedianMs([&] {
    if (++calls == 1) std::this_thread::sleep_for(std::chrono::milliseconds(200));
  });
  EXPECT_GT(calls, 10);
  EXPECT_LT(ms, 100) << "the first call alone was slow";
}

}  // namespace
}  // namespace daumier::ablation
