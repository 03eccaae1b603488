#pragma once
#include "render/image.h"

#include <string>

namespace daumier::render {

/// The bytes of a PNG file of a picture that is not empty, grey or RGB. Paeth's filter and run lengths take
/// less time than zlib's search for repeated bytes, for sheets that are a little larger.
/// @throws Error with libpng's message if it fails.
std::string EncodePng(const Image& image);

}  // namespace daumier::render
