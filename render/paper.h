#pragma once
#include "render/image.h"

namespace daumier::render {

/// A drawing as it would be on evenly lit white paper: H x W grey, paper 255, lines darker. Light lines on dark are
/// inverted; each pixel is divided by the paper's brightness there, which is a quadratic over the picture that lies on
/// its bright side (light, vignetting), times what a closing finds (shadows, stains). Dark areas stay dark however
/// large.
/// @throws Error if the picture is empty.
Image NormaliseBackground(const Image& picture);

}  // namespace daumier::render
