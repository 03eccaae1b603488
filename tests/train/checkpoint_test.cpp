#include "train/checkpoint.h"

#include "core/files.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::train {
namespace {

namespace fs = std::filesystem;

Checkpoint OfStep(int step) {
  Checkpoint checkpoint;
  checkpoint.model = {{"weight", torch::full({2, 3}, double(step))}};
  checkpoint.optimiser = {{"mean.weight", torch::zeros({2, 3})}};
  checkpoint.random = {{"cpu", torch::arange(5, torch::kUInt8)}};
  checkpoint.state = {{"step", step}, {"best", 0.1}};
  return checkpoint;
}

int StepOf(const fs::path& directory) {
  return ReadCheckpoint(directory).value().state.at("step").get<int>();
}

TEST(Checkpoint, ReadsWhatWasWritten) {
  const testing::TempDir folder;
  EXPECT_FALSE(ReadCheckpoint(folder / "latest").has_value());
  WriteCheckpoint(folder / "latest", OfStep(7));
  const Checkpoint read = ReadCheckpoint(folder / "latest").value();
  EXPECT_TRUE(torch::equal(read.model.at("weight"), OfStep(7).model.at("weight")));
  EXPECT_TRUE(torch::equal(read.random.at("cpu"), OfStep(7).random.at("cpu")));
  EXPECT_EQ(read.state, OfStep(7).state);
}

TEST(Checkpoint, HoldsTheTrainingTimeInAFileOfItsOwn) {
  const testing::TempDir folder;
  Checkpoint checkpoint = OfStep(7);
  WriteCheckpoint(folder / "untimed", checkpoint);
  EXPECT_FALSE(ReadCheckpoint(folder / "untimed").value().seconds.has_value());
  checkpoint.seconds = 12.25;
  WriteCheckpoint(folder / "timed", checkpoint);
  EXPECT_EQ(ReadCheckpoint(folder / "timed").value().seconds, 12.25);
  EXPECT_EQ(ReadFile(folder / "timed" / "state.json"), ReadFile(folder / "untimed" / "state.json"));
  WriteFileAtomically(folder / "timed" / "time.json", "{}");
  testing::ExpectError([&] { ReadCheckpoint(folder / "timed"); }, "time.json is damaged");
}

TEST(Checkpoint, OfEqualContentHasEqualBytes) {
  const testing::TempDir folder;
  WriteCheckpoint(folder / "a", OfStep(7));
  WriteCheckpoint(folder / "b", OfStep(7));
  for (const auto& entry : fs::directory_iterator(folder / "a"))
    EXPECT_EQ(ReadFile(entry.path()), ReadFile(folder / "b" / entry.path().filename()));
}

TEST(Checkpoint, IsWholeAfterAKillAtAnyPoint) {
  const testing::TempDir folder;
  const fs::path latest = folder / "latest", fresh = folder / "latest.new", old = folder / "latest.old";
  WriteCheckpoint(latest, OfStep(1));
  // While the new one is being written: half of it lies there.
  MakeDirectory(fresh);
  WriteFileAtomically(fresh / "model.safetensors", "half");
  EXPECT_EQ(StepOf(latest), 1);
  // Between the two renames.
  fs::rename(latest, old);
  EXPECT_EQ(StepOf(latest), 1);
  // The next one is written as if nothing had happened, and leaves no remains.
  WriteCheckpoint(latest, OfStep(2));
  EXPECT_EQ(StepOf(latest), 2);
  EXPECT_FALSE(fs::exists(fresh));
  EXPECT_FALSE(fs::exists(old));
  // After both renames, before the old one is removed.
  fs::copy(latest, old, fs::copy_options::recursive);
  WriteCheckpoint(latest, OfStep(3));
  EXPECT_EQ(StepOf(latest), 3);
}

TEST(Checkpoint, RefusesDamageAndNewerVersions) {
  const testing::TempDir folder;
  const fs::path latest = folder / "latest";
  WriteCheckpoint(latest, OfStep(1));
  std::string bytes = ReadFile(latest / "optimiser.safetensors");
  bytes.back() ^= 1;
  WriteFileAtomically(latest / "optimiser.safetensors", bytes);
  testing::ExpectError([&] { ReadCheckpoint(latest); }, "optimiser.safetensors is damaged");
  WriteFileAtomically(latest / "state.json", R"({"format_version": 99, "state": {}, "checksums": {}})");
  testing::ExpectError([&] { ReadCheckpoint(latest); }, "format version 99");
  WriteFileAtomically(latest / "state.json", "{");
  testing::ExpectError([&] { ReadCheckpoint(latest); }, "state.json is damaged");
}

}  // namespace
}  // namespace daumier::train
