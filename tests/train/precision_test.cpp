#include "train/precision.h"

#include "core/error.h"
#include "core/manifest.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::train {
namespace {

std::string ResolveOnCpu(const std::string& precision, const std::filesystem::path& run, bool has_instructions) {
  return ResolvePrecision(precision, run, torch::kCPU, has_instructions);
}

void StorePrecision(const std::filesystem::path& run, const std::string& precision) {
  Manifest manifest;
  manifest.kind = "run";
  manifest.config = {{"precision", precision}};
  WriteManifest(run, manifest);
}

TEST(Precision, AutoIsBfloat16OnlyWithItsInstructions) {
  const testing::TempDir folder;
  EXPECT_EQ(ResolveOnCpu("auto", folder / "new", true), "bfloat16");
  EXPECT_EQ(ResolveOnCpu("auto", folder / "new", false), "float32");
  EXPECT_EQ(ResolvePrecision("auto", folder / "new", torch::kCUDA, true), "float32");
  for (const bool has_instructions : {false, true})
    EXPECT_EQ(ResolveOnCpu("float32", folder / "new", has_instructions), "float32");
}

TEST(Precision, Bfloat16IsRefusedWithTheReasonUnlessForced) {
  const testing::TempDir folder;
  EXPECT_THROW(ResolveOnCpu("bfloat16", folder / "new", false), UsageError);
  testing::ExpectError([&] { ResolveOnCpu("bfloat16", folder / "new", false); }, "sums would stop at 256");
  testing::ExpectError([&] { ResolveOnCpu("bfloat16", folder / "new", false); }, "precision=\"force-bfloat16\"");
  EXPECT_EQ(ResolveOnCpu("force-bfloat16", folder / "new", false), "bfloat16");
  EXPECT_EQ(ResolveOnCpu("bfloat16", folder / "new", true), "bfloat16");
  EXPECT_EQ(ResolvePrecision("bfloat16", folder / "new", torch::kCUDA, false), "bfloat16");
}

TEST(Precision, AutoKeepsThatOfTheRun) {
  const testing::TempDir folder;
  StorePrecision(folder.path(), "float32");
  EXPECT_EQ(ResolveOnCpu("auto", folder.path(), true), "float32");
  StorePrecision(folder.path(), "bfloat16");
  EXPECT_EQ(ResolveOnCpu("auto", folder.path(), true), "bfloat16");
  testing::ExpectError([&] { ResolveOnCpu("auto", folder.path(), false); }, "of a run in bfloat16");
  EXPECT_EQ(ResolveOnCpu("force-bfloat16", folder.path(), false), "bfloat16");
}

}  // namespace
}  // namespace daumier::train
