#include "faces/appearance/head_soup.h"

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

namespace daumier::faces {
namespace {

geometry::Vector3 AnyPerpendicular(const geometry::Vector3& direction) {
  return direction.unitOrthogonal();
}

/// Circles around the points of a path, whose frames turn as little as possible.
std::vector<int> TubeCircles(const std::vector<geometry::Vector3>& path, const std::vector<double>& radii,
                             int num_sides, bool closed, const Eigen::Vector3f& colour, HeadSoup& soup) {
  const size_t n = path.size();
  std::vector<int> first(n);
  geometry::Vector3 side = geometry::Vector3::Zero();
  for (size_t k = 0; k < n; ++k) {
    const geometry::Vector3& before = path[k > 0 ? k - 1 : (closed ? n - 1 : 0)];
    const geometry::Vector3& after = path[k + 1 < n ? k + 1 : (closed ? 0 : n - 1)];
    const geometry::Vector3 along = (after - before).normalized();
    if (k == 0) {
      // Of a ring the axis, so that its frames close.
      side = closed ? geometry::Vector3((path[0] - path[n / 3]).cross(path[2 * n / 3] - path[n / 3]))
                    : AnyPerpendicular(along);
    }
    side = (side - along * along.dot(side)).normalized();
    const geometry::Vector3 other = along.cross(side);
    first[k] = soup.size();
    for (int i = 0; i < num_sides; ++i) {
      const double angle = 2 * std::numbers::pi * i / num_sides;
      soup.AddVertex(path[k] + radii[k] * (std::cos(angle) * side + std::sin(angle) * other), colour);
    }
  }
  return first;
}

void JoinCircles(int a, int b, int num_sides, SoupKind kind, HeadSoup& soup) {
  for (int i = 0; i < num_sides; ++i) {
    const int j = (i + 1) % num_sides;
    soup.AddQuad(a + i, a + j, b + j, b + i, kind);
  }
}

}  // namespace

HeadSoup::HeadSoup(const geometry::Points& vertices, const Eigen::MatrixXf& colours) {
  vertices_.reserve(size_t(vertices.rows()) + 8000);
  colours_.reserve(size_t(vertices.rows()) + 8000);
  for (Eigen::Index v = 0; v < vertices.rows(); ++v) {
    vertices_.emplace_back(vertices.row(v));
    colours_.emplace_back(colours.row(v));
  }
}

int HeadSoup::AddVertex(const geometry::Vector3& point, const Eigen::Vector3f& colour) {
  vertices_.push_back(point);
  colours_.push_back(colour);
  return size() - 1;
}

void HeadSoup::AddTriangle(int a, int b, int c, SoupKind kind) {
  triangles_.emplace_back(a, b, c);
  classes_.push_back(static_cast<uint8_t>(kind.mask));
  parts_.push_back(static_cast<uint8_t>(kind.part));
}

void HeadSoup::AddQuad(int a, int b, int c, int d, SoupKind kind) {
  AddTriangle(a, b, c, kind);
  AddTriangle(a, c, d, kind);
}

PortraitHead HeadSoup::Take() {
  PortraitHead head;
  head.vertices.resize(size(), 3);
  head.colours.resize(size(), 3);
  for (int v = 0; v < size(); ++v) {
    head.vertices.row(v) = vertices_[size_t(v)].transpose();
    head.colours.row(v) = colours_[size_t(v)].cwiseMax(0.0f).cwiseMin(1.0f).transpose();
  }
  head.triangles.resize(static_cast<Eigen::Index>(triangles_.size()), 3);
  for (size_t t = 0; t < triangles_.size(); ++t) head.triangles.row(Eigen::Index(t)) = triangles_[t].transpose();
  head.classes = std::move(classes_);
  head.parts = std::move(parts_);
  return head;
}

void AddTube(const std::vector<geometry::Vector3>& path, const std::vector<double>& radii, int num_sides,
             const Eigen::Vector3f& colour, SoupKind kind, HeadSoup& soup) {
  const std::vector<int> circles = TubeCircles(path, radii, num_sides, false, colour, soup);
  for (size_t k = 0; k + 1 < circles.size(); ++k) JoinCircles(circles[k], circles[k + 1], num_sides, kind, soup);
  const int front = soup.AddVertex(path.front(), colour), end = soup.AddVertex(path.back(), colour);
  for (int i = 0; i < num_sides; ++i) {
    const int j = (i + 1) % num_sides;
    soup.AddTriangle(circles.front() + j, circles.front() + i, front, kind);
    soup.AddTriangle(circles.back() + i, circles.back() + j, end, kind);
  }
}

void AddRing(const std::vector<geometry::Vector3>& path, double radius, int num_sides, const Eigen::Vector3f& colour,
             SoupKind kind, HeadSoup& soup) {
  const std::vector<int> circles =
      TubeCircles(path, std::vector<double>(path.size(), radius), num_sides, true, colour, soup);
  for (size_t k = 0; k < circles.size(); ++k)
    JoinCircles(circles[k], circles[(k + 1) % circles.size()], num_sides, kind, soup);
}

void AddEllipsoid(const geometry::Vector3& centre, const Eigen::Matrix3d& axes, int num_rings, int num_sides,
                  const Eigen::Vector3f& colour, const Eigen::Vector3f& pole_colour, SoupKind kind, HeadSoup& soup) {
  const int top = soup.AddVertex(centre + axes.col(2), pole_colour);
  std::vector<int> first;
  for (int ring = 1; ring < num_rings; ++ring) {
    const double a = std::numbers::pi * ring / num_rings;
    const auto share = static_cast<float>(std::max(0.0, std::cos(a)));
    first.push_back(soup.size());
    for (int i = 0; i < num_sides; ++i) {
      const double b = 2 * std::numbers::pi * (i + 0.5 * (ring % 2)) / num_sides;
      soup.AddVertex(
          centre + axes * geometry::Vector3(std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a)),
          colour + share * (pole_colour - colour));
    }
  }
  const int bottom = soup.AddVertex(centre - axes.col(2), colour);
  // Columns of `axes` may be left-handed: then triangles are turned.
  const bool turned = axes.determinant() < 0;
  const auto add = [&](int a, int b, int c) {
    turned ? soup.AddTriangle(a, c, b, kind) : soup.AddTriangle(a, b, c, kind);
  };
  for (int i = 0; i < num_sides; ++i) {
    const int j = (i + 1) % num_sides;
    add(top, first.front() + i, first.front() + j);
    add(bottom, first.back() + j, first.back() + i);
    for (size_t r = 0; r + 1 < first.size(); ++r) {
      const int p = first[r], q = first[r + 1];
      add(p + i, q + i, q + j);
      add(p + i, q + j, p + j);
    }
  }
}

}  // namespace daumier::faces
