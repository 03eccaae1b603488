#pragma once
#include "runtime/siren_kernel.h"

#include <vector>

namespace daumier::runtime {

/// What the derivatives of a SIREN's displacements by its parameters consist of, of each point:
///   d displacement_i / d W_l[o][k] = gradient_l[i][o] input_l[k],  d displacement_i / d b_l[o] = gradient_l[i][o].
/// They are 3 x num_parameters numbers a point, of which this stores four a feature. Points lie in blocks, the last one
/// filled up, so that a derivative along a direction of the parameters is a product of small matrices.
class SirenFactors {
 public:
  /// Memory for num_points points, which Fill fills. @throws Error unless the width is a multiple of kProductColumns.
  SirenFactors(const SirenLayout& layout, int64_t num_points);

  /// Points of a block: a multiple of kProductColumns, those that fill up the last one included.
  int64_t block() const { return block_; }
  int64_t num_blocks() const { return (num_points_ + block_ - 1) / block_; }
  int64_t NumPointsOf(int64_t block_index) const;

  /// Computes one block; points: all of them, num_points x 3. Threads may fill different blocks at once.
  void Fill(const float* parameters, const float* points, int64_t block_index);

  /// inputs(layer) x block
  const float* Inputs(int layer, int64_t block_index) const;
  /// 3 x outputs(layer) x block
  const float* Gradients(int layer, int64_t block_index) const;

  /// Derivative of a block's displacements along `direction` of a layer's weights (outputs x inputs): 3 x block.
  /// product: memory of outputs x block numbers.
  void AlongWeights(int layer, int64_t block_index, const float* direction, float* product, float* derivative) const;
  /// The same along a direction of its biases (outputs).
  void AlongBiases(int layer, int64_t block_index, const float* direction, float* derivative) const;

 private:
  const SirenLayout layout_;
  const int64_t num_points_, block_;
  std::vector<AlignedFloats> inputs_, gradients_;  ///< Of each layer, block by block.
};

}  // namespace daumier::runtime
