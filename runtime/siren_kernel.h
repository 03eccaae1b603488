#pragma once
#include <cstddef>
#include <cstdint>
#include <new>
#include <vector>

namespace daumier::runtime {

/// The layers of a SIREN [Sitzmann et al. 2020] from three coordinates to three, and the order of their parameters in
/// one array: weights of layer 0 (outputs x inputs), its biases, those of layer 1, ... Layer 0 and the hidden layers
/// compute sin(omega (W x + b)), the last one W x + b. The width is a multiple of kProductColumns.
struct SirenLayout {
  int width = 128;
  int hidden_layers = 3;
  double omega = 30;

  int num_layers() const { return hidden_layers + 2; }
  int inputs(int layer) const { return layer == 0 ? 3 : width; }
  int outputs(int layer) const { return layer + 1 == num_layers() ? 3 : width; }
  int64_t weight_offset(int layer) const;
  int64_t bias_offset(int layer) const { return weight_offset(layer) + int64_t(outputs(layer)) * inputs(layer); }
  int64_t num_parameters() const { return weight_offset(num_layers()); }
};

/// Numbers that begin with a cache line: vectors across two lines cost a quarter of a product's speed.
template <class T>
struct CacheAligned {
  using value_type = T;
  static constexpr std::align_val_t kLine{64};
  T* allocate(std::size_t count) { return static_cast<T*>(::operator new(count * sizeof(T), kLine)); }
  void deallocate(T* numbers, std::size_t) { ::operator delete(numbers, kLine); }
  bool operator==(const CacheAligned&) const { return true; }
};
using AlignedFloats = std::vector<float, CacheAligned<float>>;

/// One SIREN on many points, block by block, so that a block's activations stay in the cache, and the memory that it
/// needs does not grow with the points. Holds the memory of one thread.
class SirenKernel {
 public:
  /// @throws Error if the width is no multiple of kProductColumns.
  explicit SirenKernel(const SirenLayout& layout);

  /// displacements = S(points); both num_points x 3.
  void Forward(const float* parameters, const float* points, int64_t num_points, float* displacements);
  /// Adds to parameter_gradient the gradient of sum(displacements * displacement_gradient). Activations are recomputed:
  /// about 1/3 more FLOPs, no stored activations.
  void Backward(const float* parameters, const float* points, int64_t num_points, const float* displacement_gradient,
                float* parameter_gradient);

 private:
  /// Copies the weights as products read them.
  void TakeWeights(const float* parameters);
  /// Of a layer inside of arrays that hold all layers.
  int64_t At(int layer) const { return int64_t(layer) * layout_.width * layout_.width; }
  /// Layer 0 or a hidden one before its sine, without the bias.
  void Multiply(int layer, const float* input, int64_t rows, float* output) const;

  const SirenLayout layout_;
  AlignedFloats weights_;     ///< As they are given, outputs x inputs.
  AlignedFloats transposed_;  ///< inputs x outputs, those of the last layer padded to kProductColumns.
  AlignedFloats weight_gradients_, first_gradient_, padded_output_;
  AlignedFloats activations_, slopes_, gradient_, next_gradient_;
};

}  // namespace daumier::runtime
