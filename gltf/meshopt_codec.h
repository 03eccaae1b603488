#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace daumier::gltf {

/// Codecs of EXT_meshopt_compression.

/// Rounds to multiples of 2^exponent, which float32 holds exactly below 2^(exponent + 23) in absolute value.
/// @throws Error if a value is larger or not finite.
void RoundToStep(std::span<float> values, int exponent);

/// Mode ATTRIBUTES: `bytes` are elements of `stride` bytes, a multiple of 4 up to 256. Lossless.
std::string EncodeElements(std::string_view bytes, size_t stride);
/// Mode ATTRIBUTES with the filter EXPONENTIAL, of multiples of 2^exponent (RoundToStep). Lossless.
std::string EncodeMultiples(std::span<const float> values, size_t columns, int exponent);
/// Mode TRIANGLES. The corners of a triangle may be rotated, which its orientation survives.
std::string EncodeTriangles(std::span<const uint32_t> indices, size_t num_vertices);

}  // namespace daumier::gltf
