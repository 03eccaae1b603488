#include "rig/blend_kernel.h"

#include "core/kernels.h"

#include <algorithm>
#include <cstring>

namespace daumier::rig {
namespace {

DAUMIER_INLINE void AddScaledBlocks(const BlendBlock* __restrict from, float weight, int count, float* __restrict to) {
  for (int block = 0; block < count; ++block, to += kBlendBlockFloats)
    for (int i = 0; i < kBlendBlockFloats; ++i) to[i] += weight * from[block].values[i];
}

}  // namespace

DAUMIER_FOR_EACH_PROCESSOR
void SumBlocks(const BlendBlock* rest, const BlendBlock* offsets, BlendTerm* terms, int num_terms, int num_blocks,
               float* positions) {
  for (int begin = 0; begin < num_blocks; begin += kBlendChunkBlocks) {
    const int end = std::min(begin + kBlendChunkBlocks, num_blocks);
    std::memcpy(positions + int64_t(begin) * kBlendBlockFloats, rest + begin, size_t(end - begin) * sizeof(BlendBlock));
    for (BlendTerm* term = terms; term != terms + num_terms; ++term)
      for (; term->next != term->end && term->next->first_block < end; ++term->next)
        AddScaledBlocks(offsets + term->next->offset, term->weight, term->next->num_blocks,
                        positions + int64_t(term->next->first_block) * kBlendBlockFloats);
  }
}

}  // namespace daumier::rig
