#pragma once
#include <span>
#include <vector>

namespace daumier::portrait {

/// Landmarks, 68 x 2, whose jaw (0 to 16) is at equal distances along its polyline: from each end to the chin (8), which
/// stay. Annotators of the 68 landmarks place the jaw so; points that are fixed on a mesh are up to a third of a step
/// away. Other landmarks are unchanged. @throws Error if there are not 68.
std::vector<float> EvenJaw(std::span<const float> landmarks);

}  // namespace daumier::portrait
