#include "rig/blend_kernel.h"

#include <gtest/gtest.h>

#include <vector>

namespace daumier::rig {
namespace {

/// Two terms over 300 blocks, more than a chunk: one adds 2 to blocks 0, 255 and 299, one 0.5 * 4 to 256 .. 257.
TEST(SumBlocks, AddsRunsOnBothSidesOfAChunksBorder) {
  constexpr int kNumBlocks = kBlendChunkBlocks + 44;
  const std::vector<BlendBlock> rest(kNumBlocks);
  std::vector<BlendBlock> offsets(5);
  for (BlendBlock& block : offsets)
    for (float& value : block.values) value = &block - offsets.data() < 3 ? 2.0f : 4.0f;
  const std::vector<BlendRun> runs = {{0, 1, 0}, {255, 1, 1}, {299, 1, 2}, {256, 2, 3}};
  std::vector<BlendTerm> terms = {{runs.data(), runs.data() + 3, 1.0f}, {runs.data() + 3, runs.data() + 4, 0.5f}};
  std::vector<float> positions(size_t(kNumBlocks) * kBlendBlockFloats + 1, -1.0f);
  // Of any alignment: one float behind that of the vector.
  SumBlocks(rest.data(), offsets.data(), terms.data(), 2, kNumBlocks, positions.data() + 1);
  for (int block = 0; block < kNumBlocks; ++block)
    for (int i = 0; i < kBlendBlockFloats; ++i)
      ASSERT_EQ(positions[size_t(1 + block * kBlendBlockFloats + i)],
                block == 0 || (block >= 255 && block <= 257) || block == 299 ? 2.0f : 0.0f)
          << block;
  EXPECT_EQ(positions[0], -1.0f);
  for (const BlendTerm& term : terms) EXPECT_EQ(term.next, term.end);
}

}  // namespace
}  // namespace daumier::rig
