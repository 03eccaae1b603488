#pragma once
#include "geometry/principal_curvature.h"
#include "render/camera.h"

#include <array>
#include <vector>

namespace daumier::render {

/// A length that makes thresholds on curvature free of the unit [DeCarlo et al. 2003; as in the authors' program]:
/// min(0.01 / q, 0.05 R), q the tenth percentile of |k1| and |k2| of up to 500 vertices, R the distance of the farthest
/// vertex from the middle of the bounding box. @throws Error if there is no vertex, or all of it is flat.
double FeatureSize(const geometry::TriangleMesh& mesh, const geometry::PrincipalCurvatures& curvatures);

/// What a view makes of the curvature, a value each vertex. With n the normal, v the unit vector towards the viewer, w
/// its projection into the tangent plane, and theta the angle between n and v:
struct ViewCurvature {
  Eigen::VectorXd n_dot_v;  ///< cos(theta)
  Eigen::VectorXd radial;   ///< kappa_r sin^2(theta), kappa_r the curvature along w, 1/cm.
  /// D_w kappa_r sin(theta) - threshold cos(theta), 1/cm^2, which over n_dot_v is positive where a zero of `radial` is
  /// a suggestive contour.
  Eigen::VectorXd rise;
};

/// `threshold` (1/cm^2) is compared with D_w kappa_r sin(theta) / cos(theta). @throws Error if a number of vertices
/// differs.
ViewCurvature ComputeViewCurvature(const geometry::TriangleMesh& mesh, const geometry::PrincipalCurvatures& curvatures,
                                   const geometry::CurvatureDerivatives& derivatives, const Camera& camera,
                                   double threshold);

/// One end of a piece of a line.
struct ContourEnd {
  Eigen::Vector3d point;
  /// Strength of the line: of suggestive contours rise / n_dot_v, of occluding ones the radial curvature, of
  /// borders nothing.
  double strength = 0;
  /// The mesh edge that it lies on, lower vertex first; a vertex twice at that vertex; {-1, -1} inside of a triangle.
  std::array<int, 2> edge = {-1, -1};
};

/// A straight piece of a line across one triangle.
struct ContourSegment {
  int triangle;
  ContourEnd from, to;
};

/// Suggestive contours before visibility [DeCarlo et al. 2003, section 3]: zeros of the radial curvature, interpolated
/// linearly in each triangle that faces the viewer at a corner at least, where rise / n_dot_v >= 0 and n_dot_v <=
/// max_n_dot_v: where the surface faces the viewer straight on, the direction of w means little.
std::vector<ContourSegment> SuggestiveContours(const geometry::TriangleMesh& mesh, const ViewCurvature& view,
                                               double max_n_dot_v = 1);

/// Occluding contours before visibility: zeros of n_dot_v, interpolated linearly, where the radial curvature is
/// positive; the others lie inside of the surface.
std::vector<ContourSegment> OccludingContours(const geometry::TriangleMesh& mesh, const ViewCurvature& view);

/// The edges that have one triangle: where the surface ends.
std::vector<ContourSegment> Borders(const geometry::TriangleMesh& mesh);

}  // namespace daumier::render
