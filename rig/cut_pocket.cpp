#include "rig/cut_pocket.h"

#include <array>
#include <cmath>
#include <optional>
#include <vector>

namespace daumier::rig {
namespace {

/// A ring of the pocket, in widths: back from the cut, away from its line in the middle, and how much narrower it is.
struct PocketRing {
  double back, open, narrower;
};
constexpr std::array<PocketRing, 4> kRings = {
    {{0.05, 0.012, 0.02}, {0.16, 0.07, 0.08}, {0.32, 0.09, 0.2}, {0.45, 0, 0.3}}};

/// side: 1 above, -1 below.
Eigen::RowVector3d PlaceInRing(const SeamLine& line, const PocketRing& ring, const geometry::Vector3& place, int side) {
  const double along = line.Coordinates(place).x();
  const double from_middle = std::min(1.0, std::abs(2 * along / line.width - 1));
  const double open = ring.open * std::sqrt(1 - from_middle * from_middle);
  return (place - ring.narrower * (along - 0.5 * line.width) * line.frame.along +
          side * open * line.width * line.frame.up - ring.back * line.width * line.frame.out)
      .transpose();
}

class PocketMaker {
 public:
  PocketMaker(const SeamLine& line, geometry::LineCut& cut) : line_(line), cut_(cut) {}

  void Make() {
    for (const geometry::RimVertex& place : cut_.rim) {
      below_.push_back(Column(place.below, -1, {}));
      above_.push_back(place.above == place.below ? below_.back() : Column(place.above, 1, below_.back().back()));
    }
    const size_t num_edges = cut_.edges.size();
    for (size_t e = 0; e < num_edges; ++e) {
      const geometry::RimEdge& edge = cut_.edges[e];
      const geometry::RimVertex &from = cut_.rim[size_t(edge.from)], &to = cut_.rim[size_t(edge.to)];
      AddStrip(below_[size_t(edge.from)], below_[size_t(edge.to)], UvOf(edge.triangle_below, from.below),
               UvOf(edge.triangle_below, to.below));
      AddStrip(above_[size_t(edge.to)], above_[size_t(edge.from)], UvOf(edge.triangle_above, to.above),
               UvOf(edge.triangle_above, from.above));
    }
    Append();
  }

 private:
  using ColumnOfRings = std::array<int, kRings.size() + 1>;  ///< A place of the cut, then those of the rings behind it.

  /// last: its place in the last ring, where that of the other side is there.
  ColumnOfRings Column(int vertex, int side, std::optional<int> last) {
    ColumnOfRings column{};
    for (size_t r = 0; r < column.size(); ++r) {
      if (last && r + 1 == column.size()) {
        column[r] = *last;
        break;
      }
      column[r] = int(cut_.mesh.vertices.rows()) + int(points_.size());
      const Eigen::RowVector3d place = cut_.mesh.vertices.row(vertex);
      points_.push_back(r == 0 ? place : PlaceInRing(line_, kRings[r - 1], place.transpose(), side));
    }
    return column;
  }

  int UvOf(int triangle, int vertex) const {
    for (int k = 0; cut_.mesh.has_uv() && k < 3; ++k)
      if (cut_.mesh.triangles(triangle, k) == vertex) return cut_.mesh.uv_triangles(triangle, k);
    return 0;
  }

  /// Behind an edge that its triangle of the skin runs along from a to b.
  void AddStrip(const ColumnOfRings& a, const ColumnOfRings& b, int uv_a, int uv_b) {
    for (size_t r = 0; r + 1 < a.size(); ++r) {
      Add({b[r], a[r], a[r + 1]}, {uv_b, uv_a, uv_a});
      Add({b[r], a[r + 1], b[r + 1]}, {uv_b, uv_a, uv_b});
    }
  }

  void Add(const Eigen::RowVector3i& corners, const Eigen::RowVector3i& uv) {
    triangles_.push_back(corners);
    uv_triangles_.push_back(uv);
  }

  void Append() {
    geometry::TriangleMesh& mesh = cut_.mesh;
    Eigen::Index row = mesh.vertices.rows();
    mesh.vertices.conservativeResize(row + std::ssize(points_), 3);
    for (const auto& point : points_) mesh.vertices.row(row++) = point;
    row = mesh.triangles.rows();
    mesh.triangles.conservativeResize(row + std::ssize(triangles_), 3);
    if (mesh.has_uv()) mesh.uv_triangles.conservativeResize(mesh.triangles.rows(), 3);
    for (size_t t = 0; t < triangles_.size(); ++t, ++row) {
      mesh.triangles.row(row) = triangles_[t];
      if (mesh.has_uv()) mesh.uv_triangles.row(row) = uv_triangles_[t];
      cut_.sources.push_back(-1);
    }
  }

  const SeamLine& line_;
  geometry::LineCut& cut_;
  std::vector<ColumnOfRings> below_, above_;  ///< Of the rows of the rim.
  std::vector<Eigen::RowVector3d> points_;
  std::vector<Eigen::RowVector3i> triangles_, uv_triangles_;
};

}  // namespace

void AddPocket(const SeamLine& line, geometry::LineCut& cut) {
  PocketMaker(line, cut).Make();
}

}  // namespace daumier::rig
