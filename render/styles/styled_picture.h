#pragma once
#include "core/random.h"
#include "render/image.h"
#include "render/styles/picture_buffers.h"
#include "render/styles/style_choice.h"

namespace daumier::render {

/// A portrait in a style: RGB of height / supersampling x width / supersampling, the background behind it
/// (DrawBackground). Light and colours are computed on the buffers and averaged over each pixel of the picture by the
/// share that is covered; media (strokes, hatches, dots) work on the averaged picture. Without supersampling, borders of
/// things are softened by their neighbours.
///
/// Promises: the same buffers, choice and state of `rng` give the same bytes. kFlat does not depend on the shade.
/// With saturation 0 all channels are equal. In kSmooth, kToon, kFlat and kClay without lines and grade, pixels that are
/// not covered are those of the background, and fully covered ones do not depend on it.
/// @throws Error as CheckPictureBuffers, or if albedo, normal or shade of a covered pixel is not finite.
Image DrawStyled(const PictureBuffers& buffers, const StyleChoice& choice, Rng& rng);

}  // namespace daumier::render
