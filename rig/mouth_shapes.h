#pragma once
#include "faces/head_material.h"
#include "geometry/mesh.h"
#include "rig/tube.h"

#include <vector>

/// Teeth and tongue of a mouth as wide as 1, its middle in the origin: x to the head's left, y up, z to the front.
namespace daumier::rig {

enum class Jaw { kUpper, kLower };

inline constexpr int kNumTeeth = 12;  ///< Of a jaw.
/// Gum, front of the teeth, edge, back of the teeth and gum around; three columns a tooth, one in each gap.
inline constexpr Tube kTeethTube{3 * kNumTeeth + 1, 8};
inline constexpr Tube kTongueTube{11, 12};

/// The teeth of a jaw and their gum along an arch, the front of the middle at z = 0 and the lips' line at y = 0, closed:
/// the edges of the upper teeth are 0.05 below that line, in front of those of the lower ones at 0.03 below it.
geometry::Points TeethPoints(Jaw jaw);
/// Of each triangle of a jaw's tube.
std::vector<faces::HeadMaterial> TeethMaterials();
/// The place of each column along the arch, 0 .. 1.
std::vector<double> TeethColumns();

/// A tongue between the lower teeth, `out` = 0, or one that hangs over the lower lip, whose root is the same, `out` = 1.
geometry::Points TonguePoints(double out);
std::vector<double> TongueColumns();

/// The depth of the front of a jaw's arch at x, 0 in its middle and negative at the sides; none beyond its ends.
bool IsInArch(Jaw jaw, double x);
double ArchDepth(Jaw jaw, double x);

}  // namespace daumier::rig
