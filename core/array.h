#pragma once
#include <cstdint>
#include <functional>
#include <map>
#include <numeric>
#include <string>
#include <vector>

namespace daumier {

/// An array in memory of its own, row-major: values.size() is the product of the shape.
template <class T>
struct Array {
  std::vector<int64_t> shape;
  std::vector<T> values;

  Array() = default;
  /// An array of zeros.
  explicit Array(std::vector<int64_t> of_shape)
      : shape(std::move(of_shape)),
        values(static_cast<size_t>(std::accumulate(shape.begin(), shape.end(), int64_t{1}, std::multiplies<>()))) {}
  Array(std::vector<int64_t> of_shape, std::vector<T> of_values)
      : shape(std::move(of_shape)), values(std::move(of_values)) {}

  /// False for a default-constructed array, which means "absent".
  bool defined() const { return !shape.empty(); }
  /// Number of values of one entry of the first dimension.
  int64_t row_size() const { return std::accumulate(shape.begin() + 1, shape.end(), int64_t{1}, std::multiplies<>()); }
  /// The first value of entry `index` of the first dimension.
  T* row(int64_t index) { return values.data() + index * row_size(); }
  const T* row(int64_t index) const { return values.data() + index * row_size(); }
};

using FloatArray = Array<float>;
/// What a network reads or returns, by the names of its inputs or outputs.
using NamedArrays = std::map<std::string, FloatArray>;

}  // namespace daumier
