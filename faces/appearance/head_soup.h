#pragma once
#include "faces/appearance/portrait_head.h"

#include <vector>

namespace daumier::faces {

/// What a triangle of a portrait is.
struct SoupKind {
  PictureClass mask;
  PicturePart part;
};

/// Collects the vertices and triangles of a PortraitHead.
class HeadSoup {
 public:
  /// Begins with these vertices and colours (N x 3 each).
  HeadSoup(const geometry::Points& vertices, const Eigen::MatrixXf& colours);

  int AddVertex(const geometry::Vector3& point, const Eigen::Vector3f& colour);
  void AddTriangle(int a, int b, int c, SoupKind kind);
  /// Two triangles; a, b, c, d counter-clockwise seen from outside.
  void AddQuad(int a, int b, int c, int d, SoupKind kind);
  int size() const { return static_cast<int>(vertices_.size()); }

  PortraitHead Take();

 private:
  std::vector<geometry::Vector3> vertices_;
  std::vector<Eigen::Vector3f> colours_;
  std::vector<Eigen::Vector3i> triangles_;
  std::vector<uint8_t> classes_, parts_;
};

/// A closed tube around a path (two points or more) with a radius at each point, cm.
void AddTube(const std::vector<geometry::Vector3>& path, const std::vector<double>& radii, int num_sides,
             const Eigen::Vector3f& colour, SoupKind kind, HeadSoup& soup);

/// A closed tube along a closed path (three points or more).
void AddRing(const std::vector<geometry::Vector3>& path, double radius, int num_sides, const Eigen::Vector3f& colour,
             SoupKind kind, HeadSoup& soup);

/// A closed ellipsoid with half axes in the columns of `axes`, cm; its pole along the last one. Colours go from `colour`
/// to `pole_colour` at that pole.
void AddEllipsoid(const geometry::Vector3& centre, const Eigen::Matrix3d& axes, int num_rings, int num_sides,
                  const Eigen::Vector3f& colour, const Eigen::Vector3f& pole_colour, SoupKind kind, HeadSoup& soup);

}  // namespace daumier::faces
