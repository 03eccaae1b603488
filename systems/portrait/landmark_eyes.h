#pragma once
#include "systems/portrait/landmark_crop.h"

#include <span>
#include <vector>

namespace daumier::portrait {

/// Moves each landmark of the eyes, 36 to 47, to the nearest point of the boundary of the parsed eyes [Pan et al. 2024,
/// section 3.2.1], where that is at most `reach` of the width of its eye away; others stay. landmarks: 68 x 2, pixels of the
/// picture; labels: scores of PictureClass, 8 x n x n cells of the frame's crop. The boundary runs where the score of eyes
/// equals the highest other one.
std::vector<float> SnapEyes(std::span<const float> landmarks, std::span<const float> labels, const CropFrame& frame,
                            double reach = 0.2);

}  // namespace daumier::portrait
