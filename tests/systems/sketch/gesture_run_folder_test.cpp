#include "systems/sketch/gesture_run_folder.h"

#include "tests/support/expect_error.h"
#include "tests/support/gesture_runs.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::sketch {
namespace {

using testing::ExpectError;
using testing::TempDir;

TEST(GestureRunFolder, HasTheNetworkAndTheThresholdOfTheRun) {
  const TempDir folder;
  testing::WriteGestureRunFolder(folder / "run", RejectionToJson({.threshold = 0.8, .accepted = 0.97}));
  EXPECT_EQ(ReadGestureRunFolder(folder / "run").network_options.kind, "compact");
  const GestureDecision decision = ReadGestureDecision(folder / "run");
  EXPECT_EQ(decision.network_options.kind, "compact");
  EXPECT_EQ(decision.rejection.threshold, 0.8);
  EXPECT_EQ(decision.rejection.accepted, 0.97);
  ExpectError([&] { ReadGestureRunFolder(folder / "absent"); }, "absent");
}

TEST(GestureRunFolder, RefusesARunWithoutAThreshold) {
  const TempDir folder;
  testing::WriteGestureRunFolder(folder / "run", nullptr);
  ExpectError([&] { ReadGestureDecision(folder / "run"); }, "details.rejection is null");
  ExpectError(
      [] {
        RejectionFromJson({{"threshold", 2}, {"accepted", 1}}, "manifest.json");
      },
      "manifest.json: details.rejection is");
}

}  // namespace
}  // namespace daumier::sketch
