#include "datasets/build/gestures.h"

#include "core/config.h"
#include "core/files.h"
#include "core/manifest.h"
#include "datasets/read/gesture_database.h"
#include "tests/support/cancelled_task.h"
#include "tests/support/expect_error.h"
#include "tests/support/paths.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::datasets {
namespace {

namespace fs = std::filesystem;
using testing::ExpectError;
using testing::TempDir;

const GesturesOptions kTwoShards{.num_hands = 60, .per_gesture = 1, .none = 2, .seed = 3};

TEST(BuildGestures, TheSameSeedGivesTheSameBytesAndAnInterruptedBuildToo) {
  const TempDir folder;
  BuildGestures(kTwoShards, folder / "whole");
  ExpectError([&] { BuildGestures(kTwoShards, folder / "stopped", testing::CancelledTask()); }, "stopped after");
  BuildGestures(kTwoShards, folder / "stopped");
  EXPECT_EQ(DataHash(folder / "stopped"), DataHash(folder / "whole"));
  GesturesOptions other = kTwoShards;
  other.seed = 4;
  BuildGestures(other, folder / "other");
  EXPECT_NE(Sha256OfFile(folder / "other" / GestureShardName(0)), Sha256OfFile(folder / "whole" / GestureShardName(0)));
}

TEST(BuildGestures, AHandDrawsTheSameWhateverTheNumberOfHands) {
  const TempDir folder;
  GesturesOptions fewer = kTwoShards;
  fewer.num_hands = 50;
  BuildGestures(kTwoShards, folder / "more");
  BuildGestures(fewer, folder / "fewer");
  EXPECT_EQ(ReadFile(folder / "more" / GestureShardName(0)), ReadFile(folder / "fewer" / GestureShardName(0)));
}

TEST(BuildGestures, TheManifestNamesTheClassesAndASheetShowsThem) {
  const TempDir folder;
  BuildGestures(kTwoShards, folder / "gestures");
  const Manifest manifest = ReadManifest(folder / "gestures", "gestures");
  EXPECT_EQ(manifest.details.at("gestures").size(), size_t{kNumGestures} + 1);
  EXPECT_EQ(manifest.details.at("other_strokes").size(), size_t{kNumOtherStrokeKinds});
  EXPECT_EQ(manifest.counts.at("strokes"), 60 * 12);
  EXPECT_TRUE(manifest.checksums.contains("examples.png"));
}

TEST(BuildGestures, RefusesHandsThatDrawNothing) {
  const TempDir folder;
  EXPECT_THROW(BuildGestures({.per_gesture = 0, .none = 0}, folder / "none"), UsageError);
  ExpectError([&] { BuildGestures({.hand = {.smallest_px = 500, .largest_px = 60}}, folder / "none"); },
              "hand.smallest_px=500");
  ExpectError([] { ParseOptions<GesturesOptions>({{"num_hand", 3}}, "options"); }, "did you mean 'num_hands'?");
}

TEST(GesturesConfig, TheStrokesOfTheClassifierAreParsed) {
  const fs::path file = testing::SourceRoot() / "configs/gestures/strokes.toml";
  EXPECT_GT(ParseOptions<GesturesOptions>(LoadConfig(file), file.string()).num_hands, 10);
}

}  // namespace
}  // namespace daumier::datasets
