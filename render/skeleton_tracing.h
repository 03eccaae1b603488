#pragma once
#include "render/skeleton_graph.h"
#include "render/strokes.h"

#include <vector>

namespace daumier::render {

/// The strokes that a pen would have drawn, in pixels of the skeleton, kind 0. A line goes straight on through a
/// junction if another leaves it at an angle of 50 degrees at most, the straightest pair first; all others end there.
/// Lines are smoothed, which takes out the steps of pixels but leaves both ends of a line where they are, and reduced
/// to the points without which they would move by more than a quarter of a pixel. A closed line ends where it begins.
std::vector<Stroke> TraceSkeleton(const SkeletonGraph& graph);

}  // namespace daumier::render
