#pragma once
#include "faces/face_model.h"

#include <array>

namespace daumier::fitting {

inline constexpr int kNumForeheadLandmarks = 13;

/// The vertices of the landmarks 68 .. 80 that a set of 81 adds to the 68, in its order: dlib's predictor of 81 points.
/// They lie along the hairline, from the temple next to landmark 0 (number 77) over the forehead (70, 71) to that next to
/// landmark 16 (number 78), at equal distances: 77, 75, 76, 68, 69, 70, 71, 80, 72, 73, 79, 74, 78.
/// @throws Error as faces::Scalp.
std::array<int, kNumForeheadLandmarks> ForeheadLandmarks(const faces::FaceTemplate& face_template);

}  // namespace daumier::fitting
