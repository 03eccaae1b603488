#pragma once
#include "faces/head_material.h"
#include "geometry/mesh.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace daumier::faces {

/// An eyeball that looks to +z: an ellipsoid with a round iris, over which the cornea bulges by
///   bulge (1 - (d / iris_radius)^2)^2
/// along z at a distance d from the axis of gaze.
struct Eyeball {
  geometry::Vector3 centre;  ///< cm
  geometry::Vector3 radii;   ///< Half axes along x, y and z, cm.
  double iris_radius = 0;    ///< In the plane of x and y, cm.
  double bulge = 0;          ///< cm

  /// The height of its front over its centre at (x, y) from its axis; 0 outside its outline.
  double Front(double x, double y) const;
};

/// Finds the eyeball of an opening between lids on any face of a topology. On every face, w is the distance between the
/// corners of the lids (those of least and largest x on the neutral face), h the mean height of the upper lid over the
/// lower one, but at least the neutral face's share of w: so a lid that closes moves over a ball that stays.
/// - Half axes: 0.6 w along x and z; along y as much, but at least 0.95 h.
/// - Centre: along x and y as far from (middle of the corners, lower lid's mean + h / 2), in parts of w, as on the
///   neutral face, where a ball of that radius fits the lids best in the least-squares sense; at most 0.12 w along x and
///   0.035 w along y. Along z as
///   far in front as the lids and the skin around them allow, which stay in front of the ball by 0.008 w or more.
/// - Iris: a radius of 0.215 w; a bulge of 0.05 w.
/// Maxima and minima are smooth ones, so that the ball is a smooth function of the vertices.
class EyeballFit {
 public:
  /// `lids`: the loop of the opening. The skin around it are the vertices and the middles of the
  /// triangles within 1.2 w of its middle on the neutral face.
  /// @throws Error if the loop has fewer than four vertices or no width.
  EyeballFit(const geometry::TriangleMesh& neutral, const std::vector<int>& lids);

  /// vertices: V x 3, cm, of which the first ones are the topology's.
  Eyeball Fit(const geometry::Points& vertices) const;

 private:
  struct Opening {
    double width, height;  ///< w, and the mean height of the upper lid over the lower one, which may be negative.
    double middle, lower;  ///< x between the corners; mean y of the lower lid.
  };
  Opening OpeningOf(const geometry::Points& vertices) const;

  int right_corner_, left_corner_;
  std::vector<int> upper_, lower_, skin_;
  std::vector<std::array<int, 3>> skin_triangles_;
  double neutral_share_ = 0;   ///< Height of the neutral opening as a share of its width.
  double aside_ = 0, up_ = 0;  ///< Of the centre, from the middle of the opening, as shares of the width.
};

/// The topology of an eyeball: a pole in front, rings around the axis of gaze, of which the first bound pupil, iris and
/// limbus, and a pole behind. Vertices are numbered from 0: front pole, rings, rear pole.
struct EyeballMesh {
  std::vector<Eigen::Vector3i> triangles;  ///< Oriented outwards.
  std::vector<HeadMaterial> materials;     ///< Of each triangle.
};
const EyeballMesh& EyeballTopology();
int NumEyeballVertices();
/// Positions of the vertices, NumEyeballVertices() x 3.
geometry::Points EyeballPoints(const Eyeball& eyeball);
/// Of each vertex (u, v) as a disc around (0.5, 0.5), the front within half its radius.
geometry::TextureCoordinates EyeballUv();

}  // namespace daumier::faces
