#pragma once
#include "faces/face_model.h"
#include "fitting/portrait_view.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace daumier::fitting {

/// Where the landmarks of the jaw (iBUG 0 .. 16) may be in a picture: the silhouette of a turned head is further in
/// on the face than the template's vertices. Of each landmark a line of candidates: the first part of the shortest
/// path over the mesh from the template's vertex to a landmark of eye, nose or mouth at about its height; of the chin
/// its vertex alone. Made from the 68 landmarks, for any annotated template.
class ContourPaths {
 public:
  static constexpr int kNumJaw = 17;

  /// @throws Error if a landmark is not annotated.
  explicit ContourPaths(const faces::FaceTemplate& face_template);

  /// The vertices of a path, from the template's own inwards.
  const std::vector<int>& vertices(int landmark) const { return paths_[size_t(landmark)].vertices; }
  /// All of them, ascending, each once.
  std::vector<int> AllVertices() const;

  /// The position in the path of the candidate that is outermost in the picture: there the surface turns away from the
  /// viewer, its normal is perpendicular to the view. pixels: a row a candidate, y down; roll of the head, radians.
  int Outermost(int landmark, const PicturePoints& pixels, double roll) const;

 private:
  struct Path {
    std::vector<int> vertices;
    Eigen::Vector2d outwards;  ///< In the picture of an upright face: x to the right, y up.
  };
  std::array<Path, kNumJaw> paths_;
};

}  // namespace daumier::fitting
