#pragma once
#include "faces/appearance/head_soup.h"
#include "faces/appearance/looks.h"

#include <vector>

namespace daumier::faces {

/// What a head stands on: the neck below its border, shoulders in a garment. Closed surfaces. `border`: points of the
/// lower border of the head in any order; nothing is added where there are fewer than six.
void AddBust(const std::vector<geometry::Vector3>& border, const Eigen::Vector3f& skin_colour, double size,
             const Looks& looks, HeadSoup& soup);

}  // namespace daumier::faces
