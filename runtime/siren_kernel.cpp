#include "runtime/siren_kernel.h"

#include "core/error.h"
#include "runtime/block_product.h"
#include "runtime/siren_math.h"

#include <algorithm>

namespace daumier::runtime {
namespace {

/// Points whose activations are in memory at once: those of four layers, and as many slopes, fit a second-level cache.
constexpr int64_t kBlock = 240;

}  // namespace

int64_t SirenLayout::weight_offset(int layer) const {
  int64_t offset = 0;
  for (int i = 0; i < layer; ++i) offset += int64_t(outputs(i)) * (inputs(i) + 1);
  return offset;
}

SirenKernel::SirenKernel(const SirenLayout& layout)
    : layout_(layout), padded_output_(size_t(kBlock * kProductColumns)) {
  DAUMIER_CHECK(layout.width % kProductColumns == 0, "the width of a SIREN is {}, expected a multiple of {}",
                layout.width, kProductColumns);
}

void SirenKernel::TakeWeights(const float* parameters) {
  const int num_layers = layout_.num_layers();
  weights_.resize(size_t(At(num_layers)));
  transposed_.assign(size_t(At(num_layers)), 0);
  constexpr int64_t kTile = 16;
  for (int layer = 0; layer < num_layers; ++layer) {
    const float* const from = parameters + layout_.weight_offset(layer);
    float* const to = transposed_.data() + At(layer);
    const int64_t inputs = layout_.inputs(layer), outputs = layout_.outputs(layer);
    const int64_t columns = std::max(outputs, kProductColumns);
    std::copy_n(from, inputs * outputs, weights_.data() + At(layer));
    for (int64_t begin = 0; begin < outputs; begin += kTile)
      for (int64_t input = 0; input < inputs; ++input)
        for (int64_t output = begin; output < std::min(begin + kTile, outputs); ++output)
          to[input * columns + output] = from[output * inputs + input];
  }
}

void SirenKernel::Multiply(int layer, const float* input, int64_t rows, float* output) const {
  BlockProduct(input, Factor::kPlain, transposed_.data() + At(layer), rows, layout_.inputs(layer), layout_.width,
               ProductTo::kValue, output);
}

void SirenKernel::Forward(const float* parameters, const float* points, int64_t num_points, float* displacements) {
  const int last = layout_.num_layers() - 1;
  const int64_t width = layout_.width;
  TakeWeights(parameters);
  activations_.resize(size_t(2 * kBlock * width));
  for (int64_t begin = 0; begin < num_points; begin += kBlock) {
    const int64_t rows = std::min(kBlock, num_points - begin);
    const float* input = points + 3 * begin;
    for (int layer = 0; layer < last; ++layer) {
      float* const output = activations_.data() + (layer % 2) * kBlock * width;
      Multiply(layer, input, rows, output);
      SineOfBlock(output, parameters + layout_.bias_offset(layer), rows, width, float(layout_.omega));
      input = output;
    }
    BlockProduct(input, Factor::kPlain, transposed_.data() + At(last), rows, width, kProductColumns, ProductTo::kValue,
                 padded_output_.data());
    const float* const bias = parameters + layout_.bias_offset(last);
    for (int64_t row = 0; row < rows; ++row)
      for (int64_t i = 0; i < 3; ++i)
        displacements[3 * (begin + row) + i] = padded_output_[size_t(row * kProductColumns + i)] + bias[i];
  }
}

void SirenKernel::Backward(const float* parameters, const float* points, int64_t num_points,
                           const float* displacement_gradient, float* parameter_gradient) {
  const int last = layout_.num_layers() - 1;
  const int64_t width = layout_.width, area = kBlock * width;
  TakeWeights(parameters);
  activations_.resize(size_t(last * area));
  slopes_.resize(size_t(last * area));
  gradient_.resize(size_t(area));
  next_gradient_.resize(size_t(area));
  weight_gradients_.assign(size_t(At(last + 1)), 0);
  first_gradient_.assign(size_t(3 * width), 0);
  for (int64_t begin = 0; begin < num_points; begin += kBlock) {
    const int64_t rows = std::min(kBlock, num_points - begin);
    const float* const block = points + 3 * begin;
    for (int layer = 0; layer < last; ++layer) {
      float* const output = activations_.data() + layer * area;
      Multiply(layer, layer == 0 ? block : output - area, rows, output);
      SineAndSlopeOfBlock(output, slopes_.data() + layer * area, parameters + layout_.bias_offset(layer), rows, width,
                          float(layout_.omega));
    }
    const float* gradient = displacement_gradient + 3 * begin;
    for (int layer = last; layer > 0; --layer) {
      const int64_t outputs = layout_.outputs(layer);
      AddRowsOfBlock(gradient, rows, outputs, parameter_gradient + layout_.bias_offset(layer));
      BlockProduct(gradient, Factor::kTransposed, activations_.data() + (layer - 1) * area, outputs, rows, width,
                   ProductTo::kSum, weight_gradients_.data() + At(layer));
      BlockProduct(gradient, Factor::kPlain, weights_.data() + At(layer), rows, outputs, width, ProductTo::kValue,
                   next_gradient_.data());
      MultiplyBlock(slopes_.data() + (layer - 1) * area, rows * width, next_gradient_.data());
      std::swap(gradient_, next_gradient_);
      gradient = gradient_.data();
    }
    AddRowsOfBlock(gradient, rows, width, parameter_gradient + layout_.bias_offset(0));
    BlockProduct(block, Factor::kTransposed, gradient, 3, rows, width, ProductTo::kSum, first_gradient_.data());
  }
  for (int64_t output = 0; output < width; ++output)
    for (int64_t input = 0; input < 3; ++input)
      parameter_gradient[layout_.weight_offset(0) + 3 * output + input] +=
          first_gradient_[size_t(input * width + output)];
  for (int layer = 1; layer <= last; ++layer) {
    float* const to = parameter_gradient + layout_.weight_offset(layer);
    for (int64_t i = 0; i < layout_.outputs(layer) * width; ++i) to[i] += weight_gradients_[size_t(At(layer) + i)];
  }
}

}  // namespace daumier::runtime
