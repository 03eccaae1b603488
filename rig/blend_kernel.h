#pragma once
#include <cstdint>

namespace daumier::rig {

/// Floats that are stored or left out together: a cache line.
inline constexpr int kBlendBlockFloats = 16;
struct alignas(64) BlendBlock {
  float values[kBlendBlockFloats] = {};
};

/// Blocks of a chunk: 16 KB of positions, which stay in the first-level cache while targets are added.
inline constexpr int kBlendChunkBlocks = 256;

/// Consecutive blocks of one target within one chunk.
struct BlendRun {
  int32_t first_block;  ///< Of the positions.
  int32_t num_blocks;
  int32_t offset;  ///< Of the first one in the stored offsets.
};

/// A target of a sum: its weight, and its runs that are not added yet, ascending.
struct BlendTerm {
  const BlendRun* next;
  const BlendRun* end;
  float weight;
};

/// positions = rest + sum over terms of weight * offset, `num_blocks` whole blocks, on one thread, in the widest vectors
/// that the processor has. `positions`: 16 num_blocks floats of any alignment, no part of the others. Moves each term's
/// `next` to its `end`.
void SumBlocks(const BlendBlock* rest, const BlendBlock* offsets, BlendTerm* terms, int num_terms, int num_blocks,
               float* positions);

}  // namespace daumier::rig
