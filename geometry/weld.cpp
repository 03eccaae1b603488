#include "geometry/weld.h"

#include "core/error.h"
#include "geometry/submesh.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <utility>

namespace daumier::geometry {
namespace {

using CellKey = std::array<double, 3>;

struct CellHash {
  size_t operator()(const CellKey& key) const {
    uint64_t hash = 0;
    for (const double part : key) hash = (hash ^ std::bit_cast<uint64_t>(part)) * 0x9E3779B97F4A7C15ull;
    return hash ^ (hash >> 32);
  }
};

/// Vertices that represent their place, by cells of a grid. They are more than the tolerance apart, so that a cell has
/// few of them.
class PlaceGrid {
 public:
  PlaceGrid(const Points& points, double tolerance)
      : points_(points), tolerance_(tolerance), cell_(4 * tolerance), next_(points.rows(), kEnd) {}

  /// The vertex that represents the place of `vertex`, which is added if there is none.
  int Place(int vertex) {
    const CellKey low = Cell(vertex, -tolerance_), high = Cell(vertex, tolerance_);
    for (int corner = 0; corner < 8; ++corner) {
      CellKey key;
      bool is_new = true;
      for (int k = 0; k < 3; ++k) {
        const bool is_high = (corner >> k & 1) != 0;
        key[k] = is_high ? high[k] : low[k];
        is_new = is_new && !(is_high && high[k] == low[k]);
      }
      const auto found = is_new ? heads_.find(key) : heads_.end();
      if (found == heads_.end()) continue;
      for (int other = found->second; other != kEnd; other = next_[other]) {
        if ((points_.row(other) - points_.row(vertex)).norm() <= tolerance_) return other;
      }
    }
    int& head = heads_.try_emplace(Cell(vertex, 0), kEnd).first->second;
    next_[vertex] = std::exchange(head, vertex);
    return vertex;
  }

 private:
  static constexpr int kEnd = -1;

  /// Of a tolerance of 0 every place is its own cell; adding 0 makes -0 and 0 one.
  CellKey Cell(int vertex, double shift) const {
    CellKey key;
    for (int k = 0; k < 3; ++k) {
      const double x = points_(vertex, k) + shift + 0.0;
      key[k] = cell_ > 0 ? std::floor(x / cell_) + 0.0 : x;
    }
    return key;
  }

  const Points& points_;
  double tolerance_, cell_;
  std::unordered_map<CellKey, int, CellHash> heads_;
  std::vector<int> next_;  ///< In the list of a cell.
};

}  // namespace

std::vector<int> WeldByPlace(const Points& points, double tolerance) {
  DAUMIER_CHECK(tolerance >= 0, "vertices are welded within {} cm, expected 0 or more", tolerance);
  PlaceGrid grid(points, tolerance);
  std::vector<int> places(points.rows());
  for (int v = 0; v < points.rows(); ++v) places[v] = points.row(v).allFinite() ? grid.Place(v) : v;
  return places;
}

double WeldTolerance(const Points& points) {
  constexpr double kShare = 1e-6;
  double size = 0;
  for (int k = 0; k < 3; ++k) {
    std::vector<double> values;
    for (Eigen::Index v = 0; v < points.rows(); ++v) {
      if (points.row(v).allFinite()) values.push_back(points(v, k));
    }
    if (values.empty()) return 0;
    const auto quartile = values.begin() + std::ptrdiff_t(values.size() / 4);
    const auto last = values.begin() + std::ptrdiff_t(values.size() - 1 - values.size() / 4);
    std::nth_element(values.begin(), last, values.end());
    const double high = *last;
    std::nth_element(values.begin(), quartile, values.end());
    size = std::max(size, high - *quartile);
  }
  return kShare * size;
}

TriangleMesh WeldedSurface(const TriangleMesh& mesh, double tolerance) {
  const std::vector<int> places = WeldByPlace(mesh.vertices, tolerance);
  std::vector<std::array<int, 4>> candidates;  // Three places in ascending order and the triangle.
  candidates.reserve(static_cast<size_t>(mesh.triangles.rows()));
  for (int f = 0; f < mesh.triangles.rows(); ++f) {
    std::array<int, 4> candidate = {0, 0, 0, f};
    for (int k = 0; k < 3; ++k) candidate[k] = places[mesh.triangles(f, k)];
    std::sort(candidate.begin(), candidate.begin() + 3);
    if (candidate[0] != candidate[1] && candidate[1] != candidate[2]) candidates.push_back(candidate);
  }
  std::sort(candidates.begin(), candidates.end());
  const auto end = std::unique(candidates.begin(), candidates.end(), [](const auto& a, const auto& b) {
    return std::equal(a.begin(), a.begin() + 3, b.begin());
  });
  std::vector<int> kept, used;
  for (auto candidate = candidates.begin(); candidate != end; ++candidate) {
    kept.push_back((*candidate)[3]);
    used.insert(used.end(), candidate->begin(), candidate->begin() + 3);
  }
  std::sort(kept.begin(), kept.end());
  const VertexMap map = MapKept(used, static_cast<int>(mesh.vertices.rows()));
  return {SelectPoints(mesh.vertices, map),
          mesh.triangles(kept, Eigen::all).unaryExpr([&](int v) { return map.new_from_old[places[v]]; })};
}

}  // namespace daumier::geometry
