#include "rig/head_unwrap.h"

#include "core/error.h"
#include "geometry/operators.h"
#include "geometry/path.h"
#include "geometry/poisson.h"
#include "geometry/topology.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace daumier::rig {
namespace {

constexpr double kSquareness = 4;       // Exponent of the rounded square.
constexpr int kAreaSteps = 12;          // Solves with weights that follow the areas.
constexpr double kAreaExponent = 0.35;  // How fast they follow.
constexpr double kLargestScale = 1e3;
constexpr double kBridgeShare = 0.06;  // Weight of an edge across a hole.

double LengthOf(const std::vector<int>& loop, const geometry::Points& vertices) {
  double length = 0;
  for (size_t i = 0; i < loop.size(); ++i)
    length += (vertices.row(loop[(i + 1) % loop.size()]) - vertices.row(loop[i])).norm();
  return length;
}

/// The neck's border first.
std::vector<std::vector<int>> LoopsByLength(const geometry::Triangles& triangles, const geometry::Points& vertices) {
  auto loops = geometry::BoundaryLoops(triangles, int(vertices.rows()));
  std::stable_sort(loops.begin(), loops.end(),
                   [&](const auto& a, const auto& b) { return LengthOf(a, vertices) > LengthOf(b, vertices); });
  return loops;
}

std::vector<int> FindSeam(const geometry::TriangleMesh& head, const std::vector<int>& neck) {
  const auto behind = [&](int a, int b) { return head.vertices(a, 2) < head.vertices(b, 2); };
  const int start = *std::min_element(neck.begin(), neck.end(), behind);
  std::vector<bool> used(size_t(head.vertices.rows()), false);
  for (const int v : head.triangles.reshaped()) used[size_t(v)] = true;
  int crown = -1;
  for (int v = 0; v < head.vertices.rows(); ++v)
    if (used[size_t(v)] && (crown < 0 || head.vertices(v, 1) > head.vertices(crown, 1))) crown = v;
  return geometry::ShortestPath(head.vertices, geometry::VertexNeighbours(head.triangles, int(head.vertices.rows())),
                                start, crown);
}

/// Triangles in which the vertices of the path but its last have other numbers, V, V + 1, ..., on the right of it.
geometry::Triangles CutAlong(const std::vector<int>& path, const geometry::Triangles& triangles, int num_vertices) {
  geometry::Triangles cut = triangles;
  const geometry::Adjacency around = geometry::TrianglesAtVertices(triangles, num_vertices);
  for (size_t i = 0; i + 1 < path.size(); ++i) {
    const int here = path[i], next = path[i + 1], before = i > 0 ? path[i - 1] : -1;
    // From the triangle on the right of the next edge, around the vertex until the path comes again.
    int at = -1, from = next;
    const auto third = [&](int t, int without) {
      for (const int v : triangles.row(t))
        if (v != here && v != without) return v;
      return -1;
    };
    const auto has = [&](int t, int v) { return (triangles.row(t).array() == v).any(); };
    for (const int t : around[here])
      for (int k = 0; k < 3; ++k)
        if (triangles(t, k) == next && triangles(t, (k + 1) % 3) == here) at = t;
    while (at >= 0) {
      for (int k = 0; k < 3; ++k)
        if (triangles(at, k) == here) cut(at, k) = num_vertices + int(i);
      const int edge = third(at, from);
      if (edge == before) break;
      int beyond = -1;
      for (const int t : around[here])
        if (t != at && has(t, edge)) beyond = t;
      at = beyond;
      from = edge;
    }
  }
  return cut;
}

/// The rounded square |x|^p + |y|^p = 1, within [0, 1] x [0, 1], at a share of the way around it from the middle of its
/// top counter-clockwise.
Eigen::RowVector2d OnRoundedSquare(double share) {
  constexpr int kSteps = 4096;
  const auto at = [](double step) -> Eigen::RowVector2d {
    const double angle = std::numbers::pi * (0.5 + 2 * step / kSteps), x = std::cos(angle), y = std::sin(angle),
                 size =
                     std::pow(std::pow(std::abs(x), kSquareness) + std::pow(std::abs(y), kSquareness), 1 / kSquareness);
    return {0.5 + 0.5 * x / size, 0.5 + 0.5 * y / size};
  };
  static const std::vector<double> lengths = [&] {
    std::vector<double> sums = {0};
    for (int i = 0; i < kSteps; ++i) sums.push_back(sums.back() + (at(i + 1) - at(i)).norm());
    return sums;
  }();
  const double wanted = share * lengths.back();
  const auto above = std::upper_bound(lengths.begin() + 1, lengths.end() - 1, wanted);
  return at(double(above - lengths.begin()) - 1 + (wanted - above[-1]) / (above[0] - above[-1]));
}

Eigen::VectorXd SignedAreas(const geometry::TextureCoordinates& uv, const geometry::Triangles& triangles) {
  Eigen::VectorXd areas(triangles.rows());
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    const Eigen::RowVector2d a = uv.row(triangles(t, 0)), b = uv.row(triangles(t, 1)) - a,
                             c = uv.row(triangles(t, 2)) - a;
    areas[t] = 0.5 * (b.x() * c.y() - b.y() * c.x());
  }
  return areas;
}

/// The Laplacian of a surface whose holes have a vertex each in their middle, numbered V, V + 1, ..., with an edge to
/// each vertex around it: a share of what that one's other edges weigh.
geometry::SparseMatrix Bridged(const geometry::SparseMatrix& laplacian, const std::vector<std::vector<int>>& holes) {
  const int num_vertices = int(laplacian.rows()), num_all = num_vertices + int(holes.size());
  std::vector<Eigen::Triplet<double>> entries;
  for (int column = 0; column < num_vertices; ++column)
    for (geometry::SparseMatrix::InnerIterator entry(laplacian, column); entry; ++entry)
      entries.emplace_back(int(entry.row()), column, entry.value());
  for (size_t hole = 0; hole < holes.size(); ++hole) {
    const int middle = num_vertices + int(hole);
    for (const int v : holes[hole]) {
      const double weight = kBridgeShare * laplacian.coeff(v, v);
      for (const auto& [row, column, sign] :
           {std::array{v, middle, -1}, std::array{middle, v, -1}, std::array{v, v, 1}, std::array{middle, middle, 1}})
        entries.emplace_back(row, column, sign * weight);
    }
  }
  geometry::SparseMatrix bridged(num_all, num_all);
  bridged.setFromTriplets(entries.begin(), entries.end());
  return bridged;
}

}  // namespace

geometry::TriangleMesh UnwrapHead(const geometry::TriangleMesh& head, const Eigen::VectorXd& density) {
  const int num_vertices = int(head.vertices.rows());
  const auto borders = LoopsByLength(head.triangles, head.vertices);
  DAUMIER_CHECK(!borders.empty(), "a surface without a border cannot be laid flat");
  const std::vector<int> seam = FindSeam(head, borders.front());
  const geometry::Triangles cut = CutAlong(seam, head.triangles, num_vertices);
  geometry::TriangleMesh open{head.vertices, cut};
  open.vertices.conservativeResize(num_vertices + int(seam.size()) - 1, 3);
  for (size_t i = 0; i + 1 < seam.size(); ++i) open.vertices.row(num_vertices + int(i)) = head.vertices.row(seam[i]);

  const auto loops = LoopsByLength(open.triangles, open.vertices);
  std::vector<int> rim = loops.front();
  const auto crown = std::find(rim.begin(), rim.end(), seam.back());
  DAUMIER_CHECK(crown != rim.end(), "the seam at the back of the head is not on its border");
  std::rotate(rim.begin(), crown, rim.end());
  // Unused vertices and the middles of bridged holes are fixed and variable in turn.
  const int num_open = int(open.vertices.rows()), num_all = num_open + int(loops.size()) - 1;
  const std::vector<std::vector<int>> holes(loops.begin() + 1, loops.end());
  std::vector<bool> used(size_t(num_open), false);
  for (const int v : open.triangles.reshaped()) used[size_t(v)] = true;
  std::vector<int> fixed = rim;
  Eigen::MatrixXd places = Eigen::MatrixXd::Zero(num_all, 2);
  double walked = 0;
  const double length = LengthOf(rim, open.vertices);
  for (size_t i = 0; i < rim.size(); ++i) {
    places.row(rim[i]) = OnRoundedSquare(walked / length);
    walked += (open.vertices.row(rim[(i + 1) % rim.size()]) - open.vertices.row(rim[i])).norm();
  }
  for (int v = 0; v < num_open; ++v)
    if (!used[size_t(v)]) fixed.push_back(v);
  Eigen::VectorXd wanted(head.triangles.rows()), scales = Eigen::VectorXd::Ones(head.triangles.rows());
  for (Eigen::Index t = 0; t < wanted.size(); ++t) {
    const geometry::Vector3 a = head.vertices.row(head.triangles(t, 0)), b = head.vertices.row(head.triangles(t, 1)),
                            c = head.vertices.row(head.triangles(t, 2));
    wanted[t] = density[t] * (b - a).cross(c - a).norm();
  }
  wanted /= wanted.sum();
  geometry::TriangleMesh flat{head.vertices, head.triangles, {}, open.triangles};
  for (int step = 0; step < kAreaSteps; ++step) {
    const geometry::SparseMatrix laplacian =
        Bridged(geometry::CotangentLaplacian(open, geometry::kMinCotangent, scales), holes);
    flat.uv = geometry::SolvePoisson(laplacian, fixed, Eigen::MatrixXd::Zero(num_all, 2), places(fixed, Eigen::all))
                  .topRows(num_open);
    const Eigen::VectorXd areas = SignedAreas(flat.uv, open.triangles);
    DAUMIER_CHECK(areas.minCoeff() > 0, "the surface folds over when it is laid flat");
    if (step + 1 == kAreaSteps) break;
    // A triangle that is too large gets stiffer; as its neighbours do, so that single ones do not degenerate.
    Eigen::VectorXd ratio = (areas / areas.sum()).cwiseQuotient(wanted).array().log();
    Eigen::VectorXd sums = Eigen::VectorXd::Zero(num_open), counts = Eigen::VectorXd::Zero(num_open);
    for (Eigen::Index t = 0; t < ratio.size(); ++t)
      for (const int v : open.triangles.row(t)) {
        sums[v] += ratio[t];
        counts[v] += 1;
      }
    for (Eigen::Index t = 0; t < ratio.size(); ++t) {
      double mean = 0;
      for (const int v : open.triangles.row(t)) mean += sums[v] / counts[v] / 3;
      scales[t] = std::clamp(scales[t] * std::exp(kAreaExponent * mean), 1 / kLargestScale, kLargestScale);
    }
  }
  return flat;
}

Eigen::VectorXd FaceDensity(const geometry::TriangleMesh& head, const geometry::Points& landmarks) {
  constexpr double kMost = 6;
  const Eigen::RowVector3d middle = landmarks.colwise().mean();
  const double radius = (landmarks.rowwise() - middle).rowwise().norm().mean();
  Eigen::VectorXd density(head.triangles.rows());
  for (Eigen::Index t = 0; t < density.size(); ++t) {
    const Eigen::RowVector3d point =
        (head.vertices.row(head.triangles(t, 0)) + head.vertices.row(head.triangles(t, 1)) +
         head.vertices.row(head.triangles(t, 2))) /
        3;
    const double far = (point - middle).norm() / radius;
    density[t] = 1 + (kMost - 1) * std::exp(-0.5 * far * far);
  }
  return density;
}

}  // namespace daumier::rig
