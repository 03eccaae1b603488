#pragma once
#include "render/image.h"
#include "render/skeleton_graph.h"
#include "render/strokes.h"

#include <vector>

namespace daumier::render {

/// Strokes from TraceSkeleton(graph) that end where the pen did. Thinning ends a line up to half its width early, or in
/// a hook to a corner of its end. At each loose end (node of degree 1) what thinning bent is cut off, and the line goes
/// straight on: to the edge of the ink where the end is cut straight or runs to a point, and to half a width before it
/// where the end is round. pen_width in pixels bounds what is changed. The ink (render/ink.h) is the mask that the
/// skeleton is of. Other ends and dots are unchanged.
std::vector<Stroke> WithFullEnds(std::vector<Stroke> strokes, const SkeletonGraph& graph, const Image& ink,
                                 double pen_width);

}  // namespace daumier::render
