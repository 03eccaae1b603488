#include "faces/expression_repair.h"

#include "geometry/flips.h"

#include <algorithm>

namespace daumier::faces {
namespace {

geometry::Triangles TrianglesWithin(const geometry::Triangles& triangles, const std::vector<int>& region) {
  std::vector<int> rows;
  for (int f = 0; f < triangles.rows(); ++f) {
    const bool is_inside = std::ranges::all_of(
        triangles.row(f), [&](int v) { return std::binary_search(region.begin(), region.end(), v); });
    if (is_inside) rows.push_back(f);
  }
  return triangles(rows, Eigen::all);
}

/// Sets the rows of `field` to means over neighbours, `sweeps` times.
void Average(const geometry::Adjacency& neighbours, const std::vector<int>& vertices, int sweeps,
             geometry::Points& field) {
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    for (const int v : vertices) {
      Eigen::RowVector3d sum = field.row(v);
      for (const int other : neighbours[v]) sum += field.row(other);
      field.row(v) = sum / double(neighbours[v].size() + 1);
    }
  }
}

}  // namespace

ExpressionRepair::ExpressionRepair(const FaceTemplate& face_template)
    : triangles_(
          TrianglesWithin(face_template.triangles, RegionFor(face_template.annotation, "face", "an expression"))),
      neighbours_(geometry::VertexNeighbours(face_template.triangles, face_template.num_vertices())),
      openings_(FindOpenings(face_template)) {}

bool ExpressionRepair::RelaxFlips(const geometry::Points& regular, int round, geometry::Points& made) const {
  constexpr int kUnitingSweeps = 10;
  const std::vector<int> flipped = geometry::FlippedTriangles(regular, made, triangles_);
  if (flipped.empty()) return false;
  std::vector<int> corners;
  for (const int f : flipped) corners.insert(corners.end(), {triangles_(f, 0), triangles_(f, 1), triangles_(f, 2)});
  geometry::Points change = made - regular;
  Average(neighbours_, geometry::VerticesWithin(neighbours_, corners, round / 3), 1 + round / 2, change);
  for (int sweep = 0; sweep < kUnitingSweeps; ++sweep) {  // Slivers keep their normal only if they move as one.
    for (const int f : flipped) {
      const Eigen::RowVector3i corner = triangles_.row(f);
      const Eigen::RowVector3d mean = change(corner, Eigen::all).colwise().mean();
      for (const int v : corner) change.row(v) = mean;
    }
  }
  made = regular + change;
  return true;
}

/// Passes a shift of some vertices on to those around, less with every ring.
void ExpressionRepair::Spread(Eigen::VectorXd& shift, int num_rings) const {
  std::vector<int> done;
  for (int v = 0; v < shift.size(); ++v) {
    if (shift[v] != 0) done.push_back(v);
  }
  for (int ring = 1; ring <= num_rings; ++ring) {
    const std::vector<int> wider = geometry::VerticesWithin(neighbours_, done, 1);
    Eigen::VectorXd next = shift;
    for (const int v : wider) {
      if (shift[v] != 0) continue;
      double sum = 0;
      int count = 0;
      for (const int other : neighbours_[v]) {
        if (shift[other] != 0) sum += shift[other], ++count;
      }
      if (count > 0) next[v] = sum / count * (num_rings - ring + 1) / (num_rings + 1);
    }
    shift = next;
    done = wider;
  }
}

bool ExpressionRepair::Separate(const Opening& opening, const geometry::Points& regular, geometry::Points& made) const {
  constexpr int kNumRings = 3, kTaper = 4;
  const double excess = CrossingDepth(opening, made) - CrossingDepth(opening, regular);
  if (excess <= kCrossing) return false;
  Eigen::VectorXd shift = Eigen::VectorXd::Zero(made.rows());
  const auto push = [&](const std::vector<int>& path, double step) {
    const int last = static_cast<int>(path.size()) - 1;
    for (int i = 1; i < last; ++i)
      shift[path[i]] = step * std::min({1.0, double(i) / kTaper, double(last - i) / kTaper});
  };
  push(opening.upper, excess / 2);
  push(opening.lower, -excess / 2);
  Spread(shift, kNumRings);
  made.col(1) += shift;
  return true;
}

geometry::Points ExpressionRepair::Repair(const geometry::Points& made, const geometry::Points& regular) const {
  constexpr int kRounds = 12, kMaxRounds = 36;
  geometry::Points repaired = made;
  for (int round = 0; round < kRounds; ++round) {
    bool changed = RelaxFlips(regular, round, repaired);
    changed |= Separate(openings_.lips, regular, repaired);
    for (const Opening& lids : openings_.lids) changed |= Separate(lids, regular, repaired);
    if (!changed) return repaired;
  }
  for (int round = kRounds; round < kMaxRounds && RelaxFlips(regular, round, repaired); ++round) continue;
  return repaired;
}

}  // namespace daumier::faces
