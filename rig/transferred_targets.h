#pragma once
#include "geometry/mesh.h"
#include "rig/morph_targets.h"

namespace daumier::rig {

/// Targets of a mesh for the same mesh with another neutral shape, by deformation transfer from the old neutral
/// [Sumner and Popovic 2004]:
///   new = old + T_edited(old) - T_neutral(old),
/// T_s(o) the displacement that carries the gradients of target o to shape s (geometry::DeformationTransfer), so that
/// vertices far from an edit keep their displacements but for what the solution moves, less than 0.05 mm, up to 0.1 mm
/// damped continuously, where a vertex had none.
/// Parts of the surface without a vertex that no target moves by more than 0.01 mm, such as lower teeth, and vertices
/// without a triangle that has area in every pose have new = s old, s the ratio of the part's spread about its mean.
/// Promises: an equal shape gives equal targets; a shape scaled by s gives targets of s times the length, to 0.02 mm.
/// `edited`: V x 3, cm. On all cores.
MorphTargets TransferredTargets(const geometry::TriangleMesh& neutral, const geometry::Points& edited,
                                const MorphTargets& targets);

/// How points moved on the whole: x -> mean of `to` + scale (x - mean of `from`), scale the ratio of their spreads (root
/// mean square distance from the mean); 1 where `from` has none. Exact for any scaling and shift.
struct MeanMotion {
  geometry::Vector3 mean_from, mean_to;
  double scale = 1;

  geometry::Vector3 Apply(const geometry::Vector3& point) const { return mean_to + scale * (point - mean_from); }
};
MeanMotion MeanMotionOf(const geometry::Points& from, const geometry::Points& to);

}  // namespace daumier::rig
