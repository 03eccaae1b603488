#include "systems/sketch/parser_counts.h"

#include "tests/support/ideal_parser_network.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

namespace daumier::sketch {
namespace {

/// A batch of one drawing that shows what IdealParserNetwork sees in ink from (64, 40) to (191, 217).
SampleBatch PlainBatch(const ParserNetworkOptions& network) {
  SampleBatch batch;
  batch.samples = {0};
  FloatArray picture({1, 1, 256, 256}), points({1, faces::kNumFacePoints, 2}), weights({1, faces::kNumFacePoints});
  for (const auto& [x, y] : {std::pair(64, 40), std::pair(191, 217)}) picture.values[size_t(y * 256 + x)] = 1;
  const auto shares = testing::PlainPointShares();
  for (size_t i = 0; i < shares.size(); ++i) {
    points.values[2 * i] = float((64.5 + 127 * shares[i].x()) / 4);
    points.values[2 * i + 1] = float((40.5 + 177 * shares[i].y()) / 4);
    weights.values[i] = 1;
  }
  Array<int64_t> labels({1, network.label_side(), network.label_side()}), states({1, 4});
  std::ranges::fill(labels.values, datasets::kUnknownClass);
  labels.values[0] = int64_t(faces::LineLabel::kSilhouette);
  labels.values[1] = int64_t(faces::LineLabel::kHair);
  batch.arrays = {{"pictures", picture}, {"points", points}, {"weights", weights}};
  batch.indices = {{"labels", labels}, {"states", states}};
  return batch;
}

TEST(ParserCounts, APerfectNetworkHasNoErrorOfPointsAndStates) {
  const ParserNetworkOptions network;
  const SampleBatch batch = PlainBatch(network);
  NamedArrays outputs = testing::IdealParserNetwork(network).Run({{"pictures", batch.arrays.at("pictures")}});
  ParserCounts counts;
  counts.Add(batch, {outputs["heat_maps"], outputs["labels"], outputs["states"]}, network);
  EXPECT_LT(counts.mean_error(), 1e-3);
  EXPECT_EQ(counts.mouth.balanced_accuracy(), 1);
  EXPECT_EQ(counts.eyes.num(), 2);
  EXPECT_EQ(counts.view.balanced_accuracy(), 1);
  EXPECT_EQ(counts.labels.num(), 2);
  EXPECT_EQ(counts.labels.balanced_accuracy(), 0.5);  // It takes hair for silhouette.
}

TEST(ParserCounts, PointsThatAreNotShownDoNotCount) {
  const ParserNetworkOptions network;
  SampleBatch batch = PlainBatch(network);
  std::ranges::fill(batch.arrays.at("weights").values, 0.0f);
  NamedArrays outputs = testing::IdealParserNetwork(network).Run({{"pictures", batch.arrays.at("pictures")}});
  ParserCounts counts;
  counts.Add(batch, {outputs["heat_maps"], outputs["labels"], outputs["states"]}, network);
  EXPECT_TRUE(counts.points.empty());
  EXPECT_EQ(counts.mean_error(), 0);
}

}  // namespace
}  // namespace daumier::sketch
