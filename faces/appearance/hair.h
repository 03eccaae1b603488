#pragma once
#include "faces/appearance/hats.h"
#include "faces/appearance/head_soup.h"
#include "faces/appearance/looks.h"
#include "faces/appearance/scalp.h"

namespace daumier::faces {

/// The hair of a style as closed surfaces: a shell over the skull that dips under the skin at the hairline, hangs down
/// where it is long, and on it curls, spikes, a bun or a tail. Under a hat it is pressed flat. `size`: of the head, 1 for
/// a usual one.
void AddHair(const SkullGrid& skull, const ScalpLines& lines, const HatFit& hat, double size, const Looks& looks,
             HeadSoup& soup);

}  // namespace daumier::faces
