#include "core/run_manifest.h"

#include <gtest/gtest.h>

namespace daumier {
namespace {

TEST(RunManifest, PathsAreThoseOfTheFormat) {
  EXPECT_EQ(BestWeights("runs/a"), "runs/a/best/model.safetensors");
  EXPECT_EQ(ResolvedConfig("runs/a"), "runs/a/resolved.toml");
  EXPECT_EQ(MetricsLog("runs/a"), "runs/a/metrics.jsonl");
  EXPECT_EQ(LatestCheckpoint("runs/a"), "runs/a/checkpoints/latest");
  EXPECT_EQ(ReportDirectory("runs/a"), "runs/a/report");
  EXPECT_EQ(ReportMetrics("runs/a"), "runs/a/report/metrics.json");
}

TEST(RunManifest, TheKeyOfTheBestWeightsIsTheirPathInTheFolder) {
  EXPECT_EQ(BestWeights("runs/a").lexically_relative("runs/a"), kBestFile);
}

}  // namespace
}  // namespace daumier
