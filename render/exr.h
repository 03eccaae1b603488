#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace daumier::render {

/// A picture of named float channels, each H x W, row-major, row 0 on top.
struct FloatImage {
  int height = 0, width = 0;
  std::map<std::string, std::vector<float>> channels;
};

/// An OpenEXR 2 file of one part: scan lines of 32-bit floats, ZIP compressed in blocks of 16 lines [OpenEXR file layout,
/// 2013]. The same picture gives the same bytes.
/// @throws Error if a size is not positive, a channel has another size, or there is none, or a name is empty or longer
/// than 31 bytes.
std::string EncodeExr(const FloatImage& image);

/// Reads what EncodeExr writes: one part, scan lines in increasing order, 32-bit floats, ZIP compression.
/// @throws Error naming `name` and the cause: truncated, damaged, or of another kind.
FloatImage DecodeExr(std::string_view bytes, std::string_view name);

}  // namespace daumier::render
