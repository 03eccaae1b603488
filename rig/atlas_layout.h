#pragma once
#include "geometry/mesh.h"

#include <vector>

namespace daumier::rig {

/// A part of an atlas in coordinates of its own.
struct AtlasPiece {
  geometry::TextureCoordinates uv;  ///< Any unit and place.
  double size = 1;                  ///< Of the longer side of its bounding box, relative to the other pieces'.
};

/// Moves and scales pieces into [0, 1] x [0, 1], none turned, so that their bounding boxes keep `gutter` from each other
/// and half of it from the border, as large as a layout of columns in shelves allows, all by the same factor.
/// @throws Error if a piece has no extent or the gutters alone fill the atlas.
std::vector<geometry::TextureCoordinates> LayOut(const std::vector<AtlasPiece>& pieces, double gutter);

}  // namespace daumier::rig
