#include "core/run_manifest.h"

#include "core/files.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier {
namespace {

using testing::ExpectError;

Manifest RunOf(const Json& details) {
  Manifest manifest;
  manifest.kind = "run";
  manifest.details = details;
  return manifest;
}

TEST(SystemOf, IsTheTaskAndOfOldRunsTheirProduct) {
  EXPECT_EQ(SystemOf(RunOf({{"system", "portrait"}})), "portrait");
  EXPECT_EQ(SystemOf(RunOf({{"product", "deform"}})), "deform");
  EXPECT_EQ(SystemOf(RunOf(Json::object())), "sketch");
}

TEST(ReadFinishedRun, NamesBothTasksAndEveryOtherCause) {
  const testing::TempDir folder;
  const auto run = folder.path();
  ExpectError([&] { ReadFinishedRun(run); }, "is not a run folder");
  WriteManifest(run, RunOf({{"system", "deform"}}));
  ExpectError([&] { ReadFinishedRun(run, "sketch"); }, "this is a run of the task 'deform' (expected a run of 'sketch')");
  ExpectError([&] { ReadFinishedRun(run, "deform"); }, "has no best weights yet");
  MakeDirectory(run / "best");
  WriteFileAtomically(BestWeights(run), "weights");
  Manifest manifest = RunOf({{"system", "deform"}});
  manifest.checksums[kBestFile] = Sha256("weights");
  WriteManifest(run, manifest);
  EXPECT_EQ(SystemOf(ReadFinishedRun(run, "deform")), "deform");
  EXPECT_EQ(SystemOf(ReadFinishedRun(run)), "deform");
  WriteFileAtomically(BestWeights(run), "other weights");
  ExpectError([&] { ReadFinishedRun(run); }, "model.safetensors");
}

}  // namespace
}  // namespace daumier
