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
/// the edges of the upper teeth are 0.065 below that line, in front of those of the lower ones at 0.045 below it.
geometry::Points TeethPoints(Jaw jaw);
/// Of each triangle of a jaw's tube.
std::vector<faces::HeadMaterial> TeethMaterials();
/// The place of each column along the arch, 0 .. 1.
std::vector<double> TeethColumns();

/// A tongue that lies between the lower teeth.
geometry::Points TongueAtRest();
/// The same tongue as it hangs over a lower lip whose front is at z = lip; its root stays.
geometry::Points TongueOut(double lip);
std::vector<double> TongueColumns();

/// The depth of the front of a jaw's arch at x, 0 in its middle and negative at the sides; none beyond its ends.
bool IsInArch(Jaw jaw, double x);
double ArchDepth(Jaw jaw, double x);

}  // namespace daumier::rig
