#pragma once
#include "render/image.h"

#include <string>

namespace daumier::render {

/// The bytes of a PNG file of a picture that is not empty, grey or RGB: those that OpenCV writes at compression level 6.
/// @throws Error with libpng's message if it fails.
std::string EncodePng(const Image& image);

}  // namespace daumier::render
