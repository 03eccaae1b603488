#pragma once
#include "rig/head_parts.h"
#include "rig/head_slits.h"

#include <array>
#include <vector>

namespace daumier::rig {

/// What was done about a slit that is sealed.
enum class SlitCut : char {
  kNotSealed,
  kCut,
  kOpenEye,  ///< An eye that is open and part of the skin: there is no line of lids.
  kNoLine    ///< The line of the lips or lids does not cross the head.
};

/// A head whose sealed slits are open.
struct OpenedHead {
  /// Vertices of before keep their numbers and places; those of the cuts follow, then those of the pocket.
  geometry::TriangleMesh mesh;
  std::vector<int>
      sources;  ///< One a triangle: the row of the head's triangle that it is a piece of; -1 of the pocket.
  std::array<SlitCut, kNumFaceSlits> slits{};
  std::array<double, kNumFaceSlits> lengths{};  ///< Of the cuts, cm.
  std::array<double, kNumFaceSlits> widths{};   ///< Of their slits, from corner to corner, cm.
  int num_cut_vertices = 0;                     ///< Between those of before and those of the pocket.
};

/// How far the sides of a cut move apart, cm: places that touch are one.
inline constexpr double kCutGap = 1e-3;

/// Whether the lids of an eye, which are `open` of its width apart in the middle, are those of a closed one.
inline constexpr double kClosedEye = 0.12;

/// Opens the slits of a head that are sealed, from corner to corner: lips where places are as near to the upper lip of the
/// registered template as to the lower one, with a triangle that faces likewise; lids of closed eyes likewise. The line is
/// drawn to a groove of the head by up to kGrooveReach of the width. Behind lips without teeth or tongue comes a pocket,
/// 0.45 widths deep.
/// head: the mesh of `surface`, in the frame of the template.
OpenedHead OpenSealedSlits(const TemplateMatch& match, const HeadSurface& surface, const HeadParts& parts,
                           const HeadSlits& slits, const geometry::TriangleMesh& head);

}  // namespace daumier::rig
