#pragma once
#include "faces/marked_points.h"

#include <array>
#include <optional>

namespace daumier::faces {

/// The 68 landmarks of Multi-PIE / iBUG, and how many of them are the contour, which comes first.
inline constexpr int kNumLandmarks = 68, kNumContourLandmarks = 17;

/// 68 landmarks in iBUG order, of a mesh (3), of a picture (2), or vertices of a mesh (1).
struct OrderedLandmarks {
  std::filesystem::path file;
  int dimension = 3;
  std::array<std::optional<geometry::Vector3>, kNumLandmarks> points;
  std::optional<PatientFrame> frame;
};

/// Finds the landmark of each point: 68 points are all, in their order or that of their numbers (0 .. 67 or 1 .. 68,
/// also at the end of labels: F-1); 51 are 17 .. 67, without the contour; of other counts each point needs a number,
/// and 0 or 68 is among them. Rows of all numbers (dimension 1) are points where their count is that of 68 or 51.
/// @throws Error naming the file, the count, and the forms that are read.
OrderedLandmarks OrderLandmarks(const MarkedPoints& marked);

/// The landmark on the other side of the face; itself in the middle.
int MirroredLandmark(int landmark);

}  // namespace daumier::faces
