#pragma once
#include "rig/head_surface.h"
#include "rig/template_match.h"

#include <array>
#include <vector>

namespace daumier::rig {

/// A slit of a head of any topology.
struct HeadSlit {
  bool is_found = false;  ///< Places of both of its sides were found.
  bool is_sealed =
      false;           ///< The surface continues from one side to the other: lips without a mouth, an eye in the skin.
  double gap = 0;      ///< Mean distance between its sides in its middle, cm.
  int component = -1;  ///< The connected part that has it, where it is found.
  double way = 0;      ///< Mean way between them along the surface, cm; infinite where there is none within reach.
};

struct HeadSlits {
  std::vector<FaceSide> sides;  ///< P: of each place.
  std::array<HeadSlit, kNumFaceSlits> slits;
};

/// The sides of the slits of a head, on which the template is registered: places that lie far nearer to one side of the
/// template than to the other one have that side, and flood the others along the edges of the head. These do not cross a
/// slit that is open, however near its sides are. Where they meet, at the corners of a slit, places within a tenth of its
/// width of the other side have that of the nearest point of the template.
/// A slit is sealed if in its middle the way from side to side is at most 1.25 times their distance and 0.12 of the slit's
/// width. head: in the frame of the template.
HeadSlits FindHeadSlits(const TemplateMatch& match, const HeadSurface& head);

}  // namespace daumier::rig
