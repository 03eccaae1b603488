#pragma once
#include <opencv2/core.hpp>

#include <string>
#include <string_view>

namespace daumier::render {

/// The pixels of a PNG: 1 channel (grey), 3 (RGB) or 4 (RGBA, where the file has transparency), of 8 bits, or of 16
/// where the file has them. Palettes become colours, and 1, 2 and 4 bits of grey become 8 [ISO/IEC 15948, 13.12].
/// @throws Error naming `name` with libpng's message if it fails.
cv::Mat DecodePng(std::string_view bytes, std::string_view name);

}  // namespace daumier::render
