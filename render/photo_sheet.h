#pragma once
#include "render/image.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace daumier::render {

/// A sheet of paper in a photograph: its corners in pixels of the picture, clockwise as seen there, from the left end
/// of the side that is nearest to being the upper one. They may lie a little outside the picture.
struct PhotoSheet {
  std::array<Eigen::Vector2d, 4> corners;
};

/// Quadrilaterals of one brightness on a desk of another, the largest first: connected areas above (or, if there are
/// none, below) a threshold whose convex hull has four long straight sides. Each side is fitted to the step of
/// brightness on it with a fraction of a pixel, must show that step on most of its length, and must have the desk
/// beyond it, so that a line round a drawing is no sheet. Where that finds none, or one of which much is hidden, sheets on
/// or next to others of their brightness come first: these show the shadow of their edge on most of each side, and the
/// desk beyond a third of them all. Sides along the border of the picture do not count: a scan of
/// a whole sheet has no quadrilateral. Colours count by their least component: paper is white.
std::vector<PhotoSheet> FindSheets(const Image& picture);

}  // namespace daumier::render
