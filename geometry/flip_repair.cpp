#include "geometry/flip_repair.h"

#include "core/error.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>
#include <span>
#include <utility>

namespace daumier::geometry {
namespace {

using Eigen::Vector3d;

struct TriangleEdges {
  Vector3d first, second;

  Vector3d normal() const { return first.cross(second); }
};

TriangleEdges EdgesOf(const Points& points, const Triangles& triangles, int f) {
  const int* const corner = triangles.data() + 3 * f;
  const auto at = [&](int k) { return Eigen::Map<const Vector3d>(points.data() + 3 * corner[k]); };
  return {at(1) - at(0), at(2) - at(0)};
}

Vector3d MovedNormal(const Points& surface, const Points& displacement, const Triangles& triangles, int f) {
  const TriangleEdges e = EdgesOf(surface, triangles, f), d = EdgesOf(displacement, triangles, f);
  return (e.first + d.first).cross(e.second + d.second);
}

bool AreFolded(const Vector3d& a, const Vector3d& b) {
  static const double kLeastCosine = -std::cos(FlipRepair::kFoldDegrees * std::numbers::pi / 180);
  const double product = a.dot(b);
  return product < 0 && product < kLeastCosine * std::sqrt(a.squaredNorm() * b.squaredNorm());
}

/// The least t from 0 to 1 at which constant + linear t + square t^2 is 0; it is positive at 0 and not at 1.
double FirstZero(double constant, double linear, double square) {
  const double root = std::sqrt(std::max(0.0, linear * linear - 4 * square * constant));
  const double q = -0.5 * (linear + std::copysign(root, linear));  // Without cancellation.
  double least = 1;
  for (const double t : {q / square, constant / q})
    if (t > 0 && t < least) least = t;
  return least;
}

/// Draws the rows of some vertices to their mean, so that a share of their differences is left.
template <class Vertices>
void Contract(const Vertices& vertices, double share, Points& displacement) {
  Eigen::RowVector3d mean = Eigen::RowVector3d::Zero();
  for (const int v : vertices) mean += displacement.row(v) / double(std::size(vertices));
  for (const int v : vertices) displacement.row(v) = mean + share * (displacement.row(v) - mean);
}

void SortUnique(std::vector<int>& numbers) {
  std::ranges::sort(numbers);
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

}  // namespace

FlipRepair::FlipRepair(Triangles triangles, int num_vertices)
    : triangles_(std::move(triangles)),
      at_vertices_(TrianglesAtVertices(triangles_, num_vertices)),
      edges_of_triangle_(size_t(triangles_.rows()), {-1, -1, -1}) {
  std::map<std::pair<int, int>, std::pair<int, int>> open;  // By its ends the triangle and its side.
  for (int f = 0; f < triangles_.rows(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const int a = triangles_(f, k), b = triangles_(f, (k + 1) % 3);
      const auto [known, is_new] = open.emplace(std::minmax(a, b), std::pair(f, k));
      if (is_new) continue;
      const auto [other, side] = known->second;
      edges_of_triangle_[size_t(f)][size_t(k)] = edges_of_triangle_[size_t(other)][size_t(side)] = int(edges_.size());
      edges_.push_back({{other, f}, {a, b, triangles_(f, (k + 2) % 3), triangles_(other, (side + 2) % 3)}});
    }
  }
}

bool FlipRepair::IsTurned(const Points& surface, const Points& normals, const Points& displacement,
                          int triangle) const {
  const Vector3d normal = normals.row(triangle);
  return !(normal.dot(MovedNormal(surface, displacement, triangles_, triangle)) > 0) &&
         normal.dot(EdgesOf(surface, triangles_, triangle).normal()) > 0;
}

bool FlipRepair::IsFolded(const Points& surface, const Points& normals, const Points& displacement, int edge) const {
  const auto [a, b] = edges_[size_t(edge)].triangles;
  return AreFolded(MovedNormal(surface, displacement, triangles_, a),
                   MovedNormal(surface, displacement, triangles_, b)) &&
         !AreFolded(EdgesOf(surface, triangles_, a).normal(), EdgesOf(surface, triangles_, b).normal()) &&
         !AreFolded(normals.row(a), normals.row(b));
}

SurfaceDefects FlipRepair::Find(const Points& surface, const Points& normals, const Points& displacement) const {
  const Eigen::Index num_vertices = at_vertices_.size();
  DAUMIER_CHECK(surface.rows() == num_vertices && displacement.rows() == num_vertices,
                "{} and {} vertices, expected {}", surface.rows(), displacement.rows(), num_vertices);
  DAUMIER_CHECK(normals.rows() == triangles_.rows(), "{} normals, expected {}", normals.rows(), triangles_.rows());
  const Points moved = surface + displacement;
  Points moved_normals(triangles_.rows(), 3);
  SurfaceDefects defects;
  for (int f = 0; f < triangles_.rows(); ++f) {
    const Vector3d normal = EdgesOf(moved, triangles_, f).normal();
    moved_normals.row(f) = normal;
    if (Eigen::Map<const Vector3d>(normals.data() + 3 * f).dot(normal) > 0) continue;
    if (IsTurned(surface, normals, displacement, f)) defects.turned.push_back(f);
  }
  for (int e = 0; e < int(edges_.size()); ++e) {
    const auto normal = [&](size_t k) {
      return Eigen::Map<const Vector3d>(moved_normals.data() + 3 * edges_[size_t(e)].triangles[k]);
    };
    if (normal(0).dot(normal(1)) < 0 && IsFolded(surface, normals, displacement, e)) defects.folded.push_back(e);
  }
  return defects;
}

SurfaceDefects FlipRepair::FindAt(std::vector<int> vertices, const Points& surface, const Points& normals,
                                  const Points& displacement) const {
  SortUnique(vertices);
  std::vector<int> triangles, edges;
  for (const int v : vertices) triangles.insert(triangles.end(), at_vertices_[v].begin(), at_vertices_[v].end());
  SortUnique(triangles);
  for (const int f : triangles)
    for (const int e : edges_of_triangle_[size_t(f)])
      if (e >= 0) edges.push_back(e);
  SortUnique(edges);
  SurfaceDefects defects;
  std::ranges::copy_if(triangles, std::back_inserter(defects.turned),
                       [&](int f) { return IsTurned(surface, normals, displacement, f); });
  std::ranges::copy_if(edges, std::back_inserter(defects.folded),
                       [&](int e) { return IsFolded(surface, normals, displacement, e); });
  return defects;
}

void FlipRepair::TurnBack(const Points& surface, const Points& normals, int triangle, Points& displacement) const {
  const TriangleEdges e = EdgesOf(surface, triangles_, triangle), d = EdgesOf(displacement, triangles_, triangle);
  const Vector3d normal = normals.row(triangle);
  const double own = normal.dot(e.normal());
  const double share = FirstZero((1 - kMargin) * own, normal.dot(e.first.cross(d.second) + d.first.cross(e.second)),
                                 normal.dot(d.normal()));
  Contract(std::span(triangles_.data() + 3 * triangle, 3), share, displacement);
}

void FlipRepair::Unfold(const Points& surface, const Points& normals, int edge, Points& displacement) const {
  constexpr double kShares[] = {0.8, 0.75, 2.0 / 3, 0.5, 0};  // Of the last one: 0.8, 0.6, 0.4, 0.2 and 0 in all.
  for (const double share : kShares) {
    Contract(edges_[size_t(edge)].corners, share, displacement);
    if (!IsFolded(surface, normals, displacement, edge)) return;
  }
}

SurfaceDefects FlipRepair::Relax(const Points& surface, const Points& normals, SurfaceDefects defects, int passes,
                                 Points& displacement) const {
  for (int pass = 0; pass < passes && !defects.empty(); ++pass) {
    std::vector<int> changed;
    for (const int f : defects.turned) {
      if (!IsTurned(surface, normals, displacement, f)) continue;  // A neighbour has turned it back.
      TurnBack(surface, normals, f, displacement);
      changed.insert(changed.end(), triangles_.data() + 3 * f, triangles_.data() + 3 * f + 3);
    }
    for (const int e : defects.folded) {
      if (!IsFolded(surface, normals, displacement, e)) continue;
      Unfold(surface, normals, e, displacement);
      changed.insert(changed.end(), edges_[size_t(e)].corners.begin(), edges_[size_t(e)].corners.end());
    }
    defects = FindAt(std::move(changed), surface, normals, displacement);
  }
  return defects;
}

}  // namespace daumier::geometry
