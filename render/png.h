#pragma once
#include <cstdint>
#include <string>
#include <string_view>

namespace daumier::render {

inline constexpr uint32_t kMaxPngSide = 1u << 20;

bool IsPng(std::string_view bytes);

/// Checks the header chunk of a PNG file, IHDR (ISO/IEC 15948, 11.2.2): complete, its checksum, 1 to 2^20 pixels a side and
/// at most 2^30 in all, and a bit depth and colour type that belong together. @throws Error naming `name` and what was
/// found.
void CheckPngHeader(std::string_view bytes, std::string_view name);

/// A PNG of the chunks that make its pixels alone: header, palette, transparency, data, end. No colour profile or gamma
/// is kept: libpng refuses pictures for damage in those. What follows the end is left out; a missing end is added. @throws Error naming `name` if a checksum differs, or the data are no whole zlib stream.
std::string PixelChunksOfPng(std::string_view bytes, std::string_view name);

}  // namespace daumier::render
