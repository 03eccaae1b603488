#pragma once
#include "faces/face_model.h"

#include <utility>
#include <vector>

namespace daumier::faces {

/// The two sides of the mouth or of an eye on a template.
struct Opening {
  std::vector<int> upper, lower;           ///< Paths of vertices from the right corner to the left one; may be empty.
  std::vector<std::pair<int, int>> pairs;  ///< Vertices that face each other: upper, lower.
};

struct FaceOpenings {
  Opening lips;
  std::vector<Opening> lids;  ///< Right and left.
};

/// A loop as two paths between its vertices of least and greatest x; empty if the loop is. points: V x 3.
Opening DivideLoop(const geometry::Points& points, std::vector<int> loop);

/// Lips: the contours of FindLipContours, and the landmarks 61-67, 62-66, 63-65. Lids: the eyes' holes (FindHoles),
/// divided at their vertices of least and greatest x, and the landmarks 37-41, 38-40 and 43-47, 44-46; where an eye is
/// no hole, the landmarks alone. @throws Error as FindLipContours.
FaceOpenings FindOpenings(const FaceTemplate& face_template);

/// Mean over the pairs of y of the upper vertex minus y of the lower one, cm: 0 where they touch. `points` is V x 3.
/// @throws Error if the opening has no pairs.
double MeanGap(const Opening& opening, const geometry::Points& points);

/// How far the lower side lies above the upper one along y, cm: the greatest height of a lower vertex above the
/// upper path's highest place at its x, of the lower path's lowest place at an upper vertex's x above that vertex, and
/// of a pair's lower vertex above its upper one. 0 where none does. `points` is V x 3.
double CrossingDepth(const Opening& opening, const geometry::Points& points);

}  // namespace daumier::faces
