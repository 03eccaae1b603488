#include "runtime/siren_factors.h"

#include "core/error.h"
#include "runtime/block_product.h"
#include "runtime/siren_math.h"

#include <algorithm>

namespace daumier::runtime {
namespace {

/// Points whose inputs of a layer of 128 features fill a first-level cache.
constexpr int64_t kMostPoints = 64;

int64_t BlockFor(int64_t num_points) {
  const int64_t num_blocks = std::max<int64_t>(1, (num_points + kMostPoints - 1) / kMostPoints),
                share = std::max<int64_t>(1, (num_points + num_blocks - 1) / num_blocks);
  return (share + kProductColumns - 1) / kProductColumns * kProductColumns;
}

}  // namespace

SirenFactors::SirenFactors(const SirenLayout& layout, int64_t num_points)
    : layout_(layout), num_points_(num_points), block_(BlockFor(num_points)) {
  DAUMIER_CHECK(layout.width % kProductColumns == 0, "the width of a SIREN is {}, expected a multiple of {}",
                layout.width, kProductColumns);
  for (int layer = 0; layer < layout.num_layers(); ++layer) {
    inputs_.emplace_back(size_t(num_blocks() * layout.inputs(layer) * block_));
    gradients_.emplace_back(size_t(num_blocks() * 3 * layout.outputs(layer) * block_));
  }
}

int64_t SirenFactors::NumPointsOf(int64_t block_index) const {
  return std::min(block_, num_points_ - block_index * block_);
}

const float* SirenFactors::Inputs(int layer, int64_t block_index) const {
  return inputs_[size_t(layer)].data() + block_index * layout_.inputs(layer) * block_;
}

const float* SirenFactors::Gradients(int layer, int64_t block_index) const {
  return gradients_[size_t(layer)].data() + block_index * 3 * layout_.outputs(layer) * block_;
}

void SirenFactors::Fill(const float* parameters, const float* points, int64_t block_index) {
  const int last = layout_.num_layers() - 1;
  const int64_t width = layout_.width, area = width * block_;
  const auto inputs = [&](int layer) { return const_cast<float*>(Inputs(layer, block_index)); };
  const auto gradients = [&](int layer) { return const_cast<float*>(Gradients(layer, block_index)); };
  for (int64_t p = 0; p < NumPointsOf(block_index); ++p)
    for (int64_t k = 0; k < 3; ++k) inputs(0)[k * block_ + p] = points[3 * (block_index * block_ + p) + k];

  AlignedFloats slopes(size_t(last * area));
  const AlignedFloats no_bias(size_t(block_), 0);
  for (int layer = 0; layer < last; ++layer) {
    float* const output = inputs(layer + 1);
    const float* const bias = parameters + layout_.bias_offset(layer);
    for (int64_t o = 0; o < width; ++o) std::fill_n(output + o * block_, block_, bias[o]);
    BlockProduct(parameters + layout_.weight_offset(layer), Factor::kPlain, inputs(layer), width, layout_.inputs(layer),
                 block_, ProductTo::kSum, output);
    SineAndSlopeOfBlock(output, slopes.data() + layer * area, no_bias.data(), width, block_, float(layout_.omega));
  }

  const float* const last_weights = parameters + layout_.weight_offset(last);
  for (int64_t i = 0; i < 3; ++i) {
    for (int64_t o = 0; o < 3; ++o) std::fill_n(gradients(last) + (3 * i + o) * block_, block_, i == o ? 1.0f : 0.0f);
    for (int64_t o = 0; o < width; ++o)
      std::fill_n(gradients(last - 1) + i * area + o * block_, block_, last_weights[i * width + o]);
    for (int layer = last - 1;; --layer) {
      float* const gradient = gradients(layer) + i * area;
      MultiplyBlock(slopes.data() + layer * area, area, gradient);
      if (layer == 0) break;
      BlockProduct(parameters + layout_.weight_offset(layer), Factor::kTransposed, gradient, width, width, block_,
                   ProductTo::kValue, gradients(layer - 1) + i * area);
    }
  }
}

void SirenFactors::AlongWeights(int layer, int64_t block_index, const float* direction, float* product,
                                float* derivative) const {
  const int64_t outputs = layout_.outputs(layer);
  BlockProduct(direction, Factor::kPlain, Inputs(layer, block_index), outputs, layout_.inputs(layer), block_,
               ProductTo::kValue, product);
  for (int64_t i = 0; i < 3; ++i)
    SumOfProductsOfBlock(Gradients(layer, block_index) + i * outputs * block_, product, outputs, block_,
                         derivative + i * block_);
}

void SirenFactors::AlongBiases(int layer, int64_t block_index, const float* direction, float* derivative) const {
  const int64_t outputs = layout_.outputs(layer);
  for (int64_t i = 0; i < 3; ++i)
    BlockProduct(direction, Factor::kPlain, Gradients(layer, block_index) + i * outputs * block_, 1, outputs, block_,
                 ProductTo::kValue, derivative + i * block_);
}

}  // namespace daumier::runtime
