#pragma once
#include "faces/face_model.h"

#include <vector>

namespace daumier::faces {

/// The holes of a face by what they are, as geometry::BoundaryLoops gives them; empty where there is none.
struct FaceHoles {
  std::vector<int> mouth, eye_left, eye_right;
  std::vector<std::vector<int>> others;  ///< The neck, or the border of a face mask, and what else is open.
};

/// The hole of a part is the one whose centre is nearest to the centre of the part's landmarks, not farther than half
/// of their radius, and that stays within twice that radius. Needs triangles, neutral and landmarks.
FaceHoles FindHoles(const FaceTemplate& face);

/// Fills closing_triangles and num_eye_closing_triangles: the two sides of each eye and of the mouth are zipped from
/// one corner to the other, always along the shorter next diagonal. A missing hole is skipped.
void CloseHoles(const FaceHoles& holes, FaceTemplate& face);

}  // namespace daumier::faces
