#pragma once
#include "render/image.h"

#include <optional>

namespace daumier::render {

/// How bright soft shading leaves the paper: H x W grey, 255 where there is none. `even` is a picture on paper of even
/// brightness 255, dark lines on light, whose longer side has some hundred pixels. Shading is an area wider than lines
/// whose border is a slow ramp on most of its length: smudged pencil, soft shadows. Areas with an edge are ink or hard
/// shadows. Nothing if there is no shading.
/// @throws Error unless the picture is grey.
std::optional<Image> SoftShading(const Image& even);

}  // namespace daumier::render
