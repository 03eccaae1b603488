#pragma once
#include "geometry/mesh.h"
#include "geometry/topology.h"
#include "rig/face_contact.h"

#include <array>
#include <cstdint>
#include <vector>

/// On which side of the slits of a face a place is: what moves with the upper lip must not follow the lower one.
namespace daumier::rig {

enum class FaceSlit : uint8_t { kMouth, kRightEye, kLeftEye };
inline constexpr int kNumFaceSlits = 3;

enum class FaceSide : uint8_t {
  kNone,  ///< Apart from the slits, or beyond their corners.
  kUpperLip,
  kLowerLip,
  kRightUpperLid,
  kRightLowerLid,
  kLeftUpperLid,
  kLeftLowerLid
};

inline FaceSide UpperSide(FaceSlit slit) {
  return FaceSide(1 + 2 * int(slit));
}
inline FaceSide LowerSide(FaceSlit slit) {
  return FaceSide(2 + 2 * int(slit));
}
/// The other side of the same slit; kNone of kNone.
inline FaceSide OppositeSide(FaceSide side) {
  return side == FaceSide::kNone ? side : FaceSide(int(side) % 2 == 1 ? int(side) + 1 : int(side) - 1);
}

/// The edges that meet of each slit of a template; empty where the template lacks the hole of an eye.
using FaceSlits = std::array<SeamEdges, kNumFaceSlits>;
FaceSlits SlitsOf(const FaceContact& contact);

/// How far the sides of a slit reach along the surface, as a share of its width.
inline constexpr double kSideReach = 0.6;

/// V: the side of each vertex of a template: of the edge that is nearer along the surface, within kSideReach of the slit's
/// width. kNone where the nearest place of an edge is one of its corners.
std::vector<FaceSide> SidesOfTemplate(const geometry::TriangleMesh& surface, const FaceSlits& slits);

}  // namespace daumier::rig
