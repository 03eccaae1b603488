#pragma once
#include <Eigen/Core>

#include <optional>
#include <span>
#include <vector>

namespace daumier::render {

/// A piece of a boundary.
struct BoundaryPiece {
  Eigen::Vector2d from, to;
};

/// Where a field on a grid is zero, bilinear between the cells' centres, by marching squares [Lorensen and Cline 1987]:
/// straight pieces between crossings of the grid's lines, in the order of the cells. field: height x width; the centre of
/// cell (0, 0) is at (0.5, 0.5). A saddle is cut so that its positive corners stay apart. The border of the grid is no
/// boundary. @throws Error if the field has another size.
std::vector<BoundaryPiece> ZeroBoundary(std::span<const float> field, int height, int width);

/// The point of the pieces nearest to `point`, the first of equals; nothing if there is none within `reach`.
std::optional<Eigen::Vector2d> NearestOnBoundary(std::span<const BoundaryPiece> pieces, const Eigen::Vector2d& point,
                                                 double reach);

}  // namespace daumier::render
