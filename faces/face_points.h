#pragma once
#include "faces/drawing_terms.h"
#include "faces/face_model.h"

#include <Eigen/Core>

#include <array>
#include <optional>
#include <vector>

namespace daumier::faces {

/// Counterparts of the points of a drawing on a template, as hand-labelled drawings define them:
/// a landmark, the mean of several, the outermost vertex of a nose wing, the vertex of the curve `jaw` in the middle of
/// the face, or the nearest point of a contour.
struct FacePointVertices {
  std::array<std::vector<int>, kNumFacePoints> of_points;  ///< The point is their mean; none for points of contours.
  /// Right and left: from landmark 0 or 16 down along landmarks 1, 2 or 15, 14 and the curve `jaw` to the chin.
  std::array<std::vector<int>, 2> contours;
};

/// "Outermost" and "middle" apply to the neutral face, along x. Without the curves nose_wing_right and nose_wing_left
/// landmarks 31 and 35 take their place; without `jaw`, landmarks 3 .. 8 and 13 .. 8.
/// @throws Error if a landmark is not annotated.
FacePointVertices FindFacePoints(const FaceTemplate& face_template);

/// A contour point: the one of this contour, else none. 0 is the right side, 1 the left.
std::optional<int> ContourOf(FacePoint point);

/// A point of a face that a camera projects; of a contour the point nearest to `near`. projected: V x 2.
Eigen::Vector2d ProjectedFacePoint(const FacePointVertices& vertices, FacePoint point,
                                   const Eigen::MatrixX2d& projected, const Eigen::Vector2d& near);

/// The place on a polyline of vertices nearest to `near`: (1 - share) * projected[from] + share * projected[to].
struct PolylinePlace {
  int from = 0, to = 0;  ///< Vertices.
  double share = 0;      ///< 0 .. 1
};
/// @throws Error if the polyline is empty.
PolylinePlace NearestOnPolyline(const std::vector<int>& polyline, const Eigen::MatrixX2d& projected,
                                const Eigen::Vector2d& near);

}  // namespace daumier::faces
