#pragma once
#include "render/image.h"

namespace daumier::render {

/// How much a picture is a drawing by lines, as opposed to a painted, shaded or photographed face: P / (P + T) where
/// the picture has content. P is the share of pixels that are paper once lines are removed, T the share of tones: neither
/// paper nor black. Paper is a quadratic surface of brightness of one colour (light, vignetting, coloured paper) that is
/// not vivid; areas filled with black count as ink. Lines may be light on dark; of a photographed sheet (FindSheets) the
/// sheet counts. Content is the box of what differs from the paper, seen at its own resolution where it is small.
/// From 0 to 1; 0 if there is no paper, 1 if there is nothing on it. @throws Error if the picture is empty.
double LineArtScore(const Image& picture);

/// A picture of this score or more is a line drawing. Chosen between, and therefore not independent of, 12 line drawings
/// by people (0.94 to 1.00), 64 styled sketches (0.71 to 1.00) and a drawing with smudged cheeks (0.71) on one side, 30
/// painted caricatures (0.03 to 0.57) and 64 rendered portraits (61 are below; an ink, a halftone and a flat one are not)
/// on the other.
inline constexpr double kLeastLineArt = 0.7;

}  // namespace daumier::render
