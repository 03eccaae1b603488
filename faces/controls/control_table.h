#pragma once
#include "faces/controls/face_control.h"

#include <vector>

/// The rows of AnatomicalControls.
namespace daumier::faces {

std::vector<FaceControl> EyeControls();
std::vector<FaceControl> NoseControls();
std::vector<FaceControl> MouthControls();
std::vector<FaceControl> CheekAndChinControls();
std::vector<FaceControl> HeadControls();

}  // namespace daumier::faces
