#pragma once
#include "geometry/mesh.h"

#include <optional>
#include <vector>

namespace daumier::rig {

/// How a printed shell gets its flat base.
enum class PrintBase {
  kOpening,  ///< The edge of an opening that looks down is extended straight down.
  kCap,      ///< The edge of a closed neck, whose cap is removed, is extended straight down.
  kCut       ///< There is neither: the lowest part is cut off.
};

/// The opening of a shell that may become its base: the longest of its holes if its area vector is within 60 degrees of `down`
/// (unit length). loops: as geometry::BoundaryLoops.
std::optional<size_t> OpeningTowards(const geometry::TriangleMesh& shell, const std::vector<std::vector<int>>& loops,
                                     const geometry::Vector3& down);

/// Gives a surface whose only hole is `opening`, or that is closed if this is empty, a flat base perpendicular to -y at height
/// `level`, which is below the whole surface. An opening, or what is left open when the cap is removed, is extended straight down and closed flat;
/// the cap is the largest connected part of what looks down (within 50 degrees) and reaches within 0.15 of the height from the
/// lowest point, if that is a disc of 4 cm^2 or more, seen from below. Where the
/// edge seen from above crosses itself, or without a cap, the surface below a hundredth of its height is cut off instead and each
/// section is closed flat; the base is then where it was cut. The result is closed.
PrintBase AddFlatBase(const std::vector<int>& opening, double level, geometry::TriangleMesh& shell);

}  // namespace daumier::rig
