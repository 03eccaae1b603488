#include "gltf/meshopt_codec.h"

#include "core/error.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <climits>
#include <cmath>
#include <cstdlib>
#include <vector>

namespace daumier::gltf {
namespace {

constexpr int kMantissaBits = 24;  // Of the filter EXPONENTIAL, with the sign; the other 8 are the exponent.
constexpr uint32_t kMantissaMask = (uint32_t{1} << kMantissaBits) - 1;
constexpr int32_t kMantissaEnd = 1 << (kMantissaBits - 1);

/// Those of EXT_meshopt_compression; the library keeps them for the process.
void SetVersions() {
  [[maybe_unused]] static const bool is_set = [] {
    meshopt_encodeVertexVersion(0);
    meshopt_encodeIndexVersion(1);
    return true;
  }();
}

int32_t Multiple(float value, int exponent) {
  const double multiple = std::round(std::ldexp(static_cast<double>(value), -exponent));
  DAUMIER_CHECK(std::abs(multiple) < double(kMantissaEnd), "{} cannot be stored in steps of 2^{}", value, exponent);
  return static_cast<int32_t>(multiple);
}

}  // namespace

void RoundToStep(std::span<float> values, int exponent) {
  for (float& value : values) {
    const double rounded = std::ldexp(static_cast<double>(Multiple(value, exponent)), exponent);
    value = static_cast<float>(rounded);
  }
}

std::string EncodeElements(std::string_view bytes, size_t stride) {
  const size_t count = bytes.size() / stride;
  SetVersions();
  std::string encoded(meshopt_encodeVertexBufferBound(count, stride), '\0');
  encoded.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(encoded.data()), encoded.size(),
                                            bytes.data(), count, stride));
  DAUMIER_CHECK(!encoded.empty(), "meshoptimizer could not compress {} elements of {} bytes", count, stride);
  return encoded;
}

std::string EncodeMultiples(std::span<const float> values, size_t columns, int exponent) {
  std::vector<int32_t> multiples(values.size());
  int32_t largest = 0;
  for (size_t i = 0; i < values.size(); ++i) {
    multiples[i] = Multiple(values[i], exponent);
    largest = std::max(largest, std::abs(multiples[i]));
  }
  // In the upper bits of the mantissa they leave its lowest byte 0, instead of repeating the sign in its highest one.
  int shift = CHAR_BIT;
  while ((int64_t{largest} << shift) >= kMantissaEnd) --shift;
  std::vector<uint32_t> filtered(values.size());
  for (size_t i = 0; i < values.size(); ++i) {
    const uint32_t mantissa = static_cast<uint32_t>(multiples[i]) << shift;
    filtered[i] = (mantissa & kMantissaMask) | (static_cast<uint32_t>(exponent - shift) << kMantissaBits);
  }
  return EncodeElements({reinterpret_cast<const char*>(filtered.data()), filtered.size() * sizeof(uint32_t)},
                        columns * sizeof(uint32_t));
}

std::string EncodeTriangles(std::span<const uint32_t> indices, size_t num_vertices) {
  SetVersions();
  std::string encoded(meshopt_encodeIndexBufferBound(indices.size(), num_vertices), '\0');
  encoded.resize(meshopt_encodeIndexBuffer(reinterpret_cast<unsigned char*>(encoded.data()), encoded.size(),
                                           indices.data(), indices.size()));
  DAUMIER_CHECK(!encoded.empty(), "meshoptimizer could not compress {} corners", indices.size());
  return encoded;
}

}  // namespace daumier::gltf
