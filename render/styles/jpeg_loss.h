#pragma once
#include "render/image.h"

namespace daumier::render {

/// What baseline JPEG loses [ITU T.81; JFIF 1.02], without its bytes: YCbCr, chroma averaged over 2 x 2 pixels, cosine
/// transforms of 8 x 8 blocks rounded to multiples of the quantisation tables of Annex K, scaled by the quality as the
/// IJG library does. Independent of the version of a JPEG library. The border continues where blocks reach beyond it.
/// Constant grey pictures change by at most 1 at quality 90 and above.
/// @throws Error if the picture is not RGB or empty, or quality is not 1 to 100.
Image JpegLoss(const Image& image, int quality);

}  // namespace daumier::render
