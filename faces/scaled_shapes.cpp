#include "faces/scaled_shapes.h"

#include "core/error.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace daumier::faces {
namespace {

/// Integers of -kLargest .. kLargest.
template <class Integer>
constexpr int kLargest = std::numeric_limits<Integer>::max();

/// Appends column / scale, rounded.
template <class Integer>
void AppendScaled(const Eigen::Ref<const Eigen::VectorXf>& column, float scale, std::vector<Integer>& to) {
  for (const float value : column)
    to.push_back(scale > 0 ? static_cast<Integer>(std::lround(double(value) / double(scale))) : Integer{0});
}

template <class Integer>
std::span<const Integer> RowsOf(const SafetensorsFile& arrays, const std::string& name, int64_t count, int64_t size,
                                const std::filesystem::path& file) {
  if (count == 0) return {};
  const ArrayView& array = arrays.at(name);
  DAUMIER_CHECK(array.shape == (std::vector<int64_t>{count, size}) && array.dtype == DtypeOf<Integer>(),
                "{}: '{}' is ({}) of {} bytes, expected ({}, {}) of {}", file.string(), name,
                fmt::join(array.shape, ", "), ItemSize(array.dtype), count, size, sizeof(Integer));
  return array.As<Integer>();
}

template <class Integer>
Eigen::VectorXf ColumnOf(std::span<const Integer> rows, int64_t row, int64_t size, float scale) {
  return scale * Eigen::Map<const Eigen::Vector<Integer, Eigen::Dynamic>>(rows.data() + row * size, size)
                     .template cast<float>();
}

}  // namespace

void AddScaledShapes(SafetensorsWriter& writer, const std::string& name, const Eigen::MatrixXf& shapes,
                     double tolerance) {
  std::vector<float> scales;
  std::vector<uint8_t> bits;
  std::vector<int8_t> small;
  std::vector<int16_t> large;
  for (Eigen::Index k = 0; k < shapes.cols(); ++k) {
    const double largest = shapes.col(k).cwiseAbs().maxCoeff();
    DAUMIER_CHECK(shapes.col(k).allFinite(), "column {} of '{}' is not finite", k, name);
    const bool is_small = largest <= 2 * tolerance * kLargest<int8_t>;
    const int steps = is_small ? kLargest<int8_t> : kLargest<int16_t>;
    scales.push_back(float(largest / steps));
    bits.push_back(is_small ? 8 : 16);
    if (is_small)
      AppendScaled(shapes.col(k), scales.back(), small);
    else
      AppendScaled(shapes.col(k), scales.back(), large);
  }
  const int64_t count = shapes.cols(), size = shapes.rows();
  const int64_t num_small = size > 0 ? int64_t(small.size()) / size : 0;
  writer.Add<float>(name + "/scales", {count}, scales);
  writer.Add<uint8_t>(name + "/bits", {count}, bits);
  if (!small.empty()) writer.Add<int8_t>(name + "/int8", {num_small, size}, small);
  if (!large.empty()) writer.Add<int16_t>(name + "/int16", {count - num_small, size}, large);
}

Eigen::MatrixXf ReadScaledShapes(const SafetensorsFile& arrays, const std::string& name,
                                 const std::filesystem::path& file) {
  const ArrayView &scales = arrays.at(name + "/scales"), &bits = arrays.at(name + "/bits");
  DAUMIER_CHECK(
      scales.shape.size() == 1 && scales.shape == bits.shape && scales.dtype == Dtype::kF32 && bits.dtype == Dtype::kU8,
      "{}: '{}/scales' and '{}/bits' do not belong together", file.string(), name, name);
  int64_t num_small = 0, num_large = 0;
  for (const uint8_t width : bits.As<uint8_t>()) {
    DAUMIER_CHECK(width == 8 || width == 16, "{}: '{}/bits' has a column of {} bits, expected 8 or 16", file.string(),
                  name, int(width));
    ++(width == 8 ? num_small : num_large);
  }
  int64_t size = 0;
  for (const char* part : {"/int8", "/int16"})
    if (arrays.contains(name + part) && arrays.at(name + part).shape.size() == 2)
      size = arrays.at(name + part).shape[1];
  const auto small = RowsOf<int8_t>(arrays, name + "/int8", num_small, size, file);
  const auto large = RowsOf<int16_t>(arrays, name + "/int16", num_large, size, file);
  Eigen::MatrixXf shapes(size, scales.size());
  int64_t small_row = 0, large_row = 0;
  for (Eigen::Index k = 0; k < shapes.cols(); ++k) {
    const float scale = scales.As<float>()[size_t(k)];
    DAUMIER_CHECK(std::isfinite(scale) && scale >= 0, "{}: '{}/scales' has the scale {}", file.string(), name, scale);
    shapes.col(k) = bits.As<uint8_t>()[size_t(k)] == 8 ? ColumnOf(small, small_row++, size, scale)
                                                       : ColumnOf(large, large_row++, size, scale);
  }
  return shapes;
}

}  // namespace daumier::faces
