#pragma once
#include "faces/appearance/head_soup.h"
#include "faces/appearance/looks.h"
#include "faces/eyeball.h"

namespace daumier::faces {

/// An eyeball with its own rings of colours: pupil, iris (darker to its border), limbus, sclera; turned by the gaze about
/// its centre within its ellipsoid, so that it stays behind the lids; and highlights, thin discs in front of it.
void AddEye(const Eyeball& eyeball, const Looks& looks, HeadSoup& soup);

}  // namespace daumier::faces
