#include "benchmark/make.h"

#include "benchmark/record.h"
#include "core/config.h"
#include "core/files.h"
#include "eval/drawing_labels.h"
#include "tests/support/expect_error.h"
#include "tests/support/paths.h"
#include "tests/support/small_kit.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace daumier::benchmark {
namespace {

namespace fs = std::filesystem;
using testing::SmallKit;

TEST(MakeBenchmark, NoPersonIsInTwoSplits) {
  const Kit kit(SmallKit());
  std::map<int, std::set<size_t>> splits_of_person;
  for (size_t task = 0; task < kKitTaskNames.size(); ++task)
    for (size_t split = 0; split < kKitSplitNames.size(); ++split)
      for (const KitItem& item : kit.items(KitTask(task), KitSplit(split))) splits_of_person[item.person].insert(split);
  EXPECT_EQ(splits_of_person.size(), 10u);
  for (const auto& [person, splits] : splits_of_person) EXPECT_EQ(splits.size(), 1u) << "person " << person;
  EXPECT_EQ(kit.items(KitTask::kDrawings, KitSplit::kTest).size(), 3u * 2 * 3);
  EXPECT_EQ(kit.items(KitTask::kPortraits, KitSplit::kTest).size(), 3u);
}

/// The same by the shapes themselves: no face of the test is one of the training.
TEST(MakeBenchmark, NoFaceIsInTwoSplits) {
  const Kit kit(SmallKit());
  for (const KitItem& test : kit.items(KitTask::kCaricatures, KitSplit::kTest)) {
    const geometry::Points face = kit.TrueFace(KitTask::kCaricatures, KitSplit::kTest, test);
    for (const KitItem& train : kit.items(KitTask::kCaricatures, KitSplit::kTrain))
      EXPECT_GT((face - kit.TrueFace(KitTask::kCaricatures, KitSplit::kTrain, train)).norm(), 0.1) << test.name;
  }
}

TEST(MakeBenchmark, GivesTheSameBytesAgain) {
  const testing::TempDir folder;
  MakeBenchmark(testing::SyntheticModel(), testing::SmallKitOptions(), folder / "again");
  EXPECT_EQ(DataHash(folder / "again"), DataHash(SmallKit()));
  EXPECT_TRUE(CheckKit(folder / "again").none());
}

TEST(MakeBenchmark, ReplacesAKitAndNothingElse) {
  const testing::TempDir folder;
  MakeDirectory(folder / "own");
  WriteFileAtomically(folder / "own/notes.txt", "keep");
  EXPECT_THROW(MakeBenchmark(testing::SyntheticModel(), testing::SmallKitOptions(), folder / "own"), UsageError);
  EXPECT_EQ(ReadFile(folder / "own/notes.txt"), "keep");
}

TEST(MakeBenchmark, NeedsCaricatures) {
  BenchmarkOptions options = testing::SmallKitOptions();
  options.faces.exaggeration.gammas = {0};
  const testing::TempDir folder;
  testing::ExpectError([&] { MakeBenchmark(testing::SyntheticModel(), options, folder / "kit"); }, "needs two levels");
  EXPECT_FALSE(fs::exists(folder / "kit"));
}

TEST(MakeBenchmark, LabelsAreThoseThatScoresOfDrawingsRead) {
  const fs::path folder = SmallKit() / TruthFolder(KitTask::kDrawings, KitSplit::kTest);
  const std::vector<eval::LabelledDrawing> drawings = eval::ReadDrawingLabels(folder / "labels.json");
  EXPECT_EQ(drawings.size(), 18u);
  int num_usable = 0;
  for (const eval::LabelledDrawing& drawing : drawings) num_usable += drawing.is_scored() ? 1 : 0;
  EXPECT_GT(num_usable, 9);
}

TEST(PersonsOf, AreNeighboursWithoutGaps) {
  const PersonCounts counts{.train = 4, .validation = 1, .test = 2};
  EXPECT_EQ(PersonsOf(counts, 0).begin, 0);
  for (int split = 0; split < 2; ++split) EXPECT_EQ(PersonsOf(counts, split).end, PersonsOf(counts, split + 1).begin);
  EXPECT_EQ(PersonsOf(counts, 2).end, counts.all());
  testing::ExpectError([&] { PersonsOf(counts, 3); }, "there is no split 3");
}

TEST(BenchmarkDefinition, OfTheRepositoryIsRead) {
  const auto options = ParseOptions<BenchmarkOptions>(
      LoadConfig(testing::SourceRoot() / "configs/benchmark/benchmark-1.toml"), "benchmark-1.toml");
  EXPECT_EQ(options.name, "benchmark-1");
  EXPECT_EQ(options.persons.all(), 112);
  EXPECT_NE(options.faces.seed, 1u) << "shipped weights are trained with seed 1";
}

}  // namespace
}  // namespace daumier::benchmark
