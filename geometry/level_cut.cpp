#include "geometry/level_cut.h"

#include "core/error.h"
#include "geometry/corner_uv.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

namespace daumier::geometry {
namespace {

/// A corner of a new triangle: a vertex with its row of UV.
struct CutCorner {
  int vertex, uv;
};

class LevelCutter {
 public:
  LevelCutter(const TriangleMesh& mesh, const Eigen::VectorXd& values) : mesh_(mesh), values_(values) {
    for (const auto& row : mesh.uv.rowwise()) uv_.push_back(row);
  }

  LevelCut Cut() && {
    for (Eigen::Index t = 0; t < mesh_.triangles.rows(); ++t) AddTriangle(t);
    LevelCut cut{std::move(points_), Triangles(Eigen::Index(triangles_.size()), 3)};
    cut.uv.resize(Eigen::Index(uv_.size()), 2);
    for (size_t i = 0; i < uv_.size(); ++i) cut.uv.row(Eigen::Index(i)) = uv_[i];
    if (mesh_.has_uv()) cut.uv_triangles.resize(cut.triangles.rows(), 3);
    for (size_t t = 0; t < triangles_.size(); ++t) {
      for (int k = 0; k < 3; ++k) {
        cut.triangles(Eigen::Index(t), k) = triangles_[t][size_t(k)].vertex;
        if (mesh_.has_uv()) cut.uv_triangles(Eigen::Index(t), k) = triangles_[t][size_t(k)].uv;
      }
    }
    return cut;
  }

 private:
  bool IsRemoved(int vertex) const { return values_[vertex] > 0; }

  CutCorner CornerOf(Eigen::Index triangle, int k) const {
    return {mesh_.triangles(triangle, k), mesh_.has_uv() ? mesh_.uv_triangles(triangle, k) : 0};
  }

  /// The point on the edge from a kept corner to a removed one.
  CutCorner Crossing(const CutCorner& kept, const CutCorner& removed) {
    const auto [entry, is_new] =
        point_of_edge_.emplace(std::pair(kept.vertex, removed.vertex), static_cast<int>(points_.size()));
    if (is_new) {
      const double below = -values_[kept.vertex], share = below / (below + values_[removed.vertex]);
      points_.push_back({kept.vertex, removed.vertex, std::clamp(share, kLeastEdgeShare, 1 - kLeastEdgeShare)});
    }
    const int vertex = static_cast<int>(mesh_.vertices.rows()) + entry->second;
    if (!mesh_.has_uv()) return {vertex, 0};
    const auto [row, is_new_row] =
        uv_of_edge_.emplace(std::array{entry->second, kept.uv, removed.uv}, static_cast<int>(uv_.size()));
    if (is_new_row) {
      const double share = points_[size_t(entry->second)].share;
      uv_.push_back((1 - share) * uv_[size_t(kept.uv)] + share * uv_[size_t(removed.uv)]);
    }
    return {vertex, row->second};
  }

  void AddTriangle(Eigen::Index triangle) {
    // The polygon of the kept corners and of the crossings between them, in the triangle's direction.
    std::array<CutCorner, 4> polygon{};
    size_t size = 0;
    for (int k = 0; k < 3; ++k) {
      const CutCorner corner = CornerOf(triangle, k), next = CornerOf(triangle, (k + 1) % 3);
      const bool removed = IsRemoved(corner.vertex);
      if (!removed) polygon[size++] = corner;
      if (removed != IsRemoved(next.vertex))
        polygon[size++] = removed ? Crossing(next, corner) : Crossing(corner, next);
    }
    for (size_t k = 1; k + 1 < size; ++k) triangles_.push_back({polygon[0], polygon[k], polygon[k + 1]});
  }

  const TriangleMesh& mesh_;
  const Eigen::VectorXd& values_;
  std::vector<EdgePoint> points_;
  std::vector<Eigen::RowVector2d> uv_;
  std::vector<std::array<CutCorner, 3>> triangles_;
  std::map<std::pair<int, int>, int> point_of_edge_;
  std::map<std::array<int, 3>, int> uv_of_edge_;  ///< By point, and rows of the kept and of the removed corner.
};

}  // namespace

LevelCut CutPositive(const TriangleMesh& mesh, const Eigen::VectorXd& values) {
  DAUMIER_CHECK(values.size() == mesh.vertices.rows(), "{} values were given for {} vertices", values.size(),
                mesh.vertices.rows());
  CheckUv(mesh);
  return LevelCutter(mesh, values).Cut();
}

Points WithEdgePoints(const Points& vertices, const std::vector<EdgePoint>& points) {
  Points all(vertices.rows() + Eigen::Index(points.size()), 3);
  all.topRows(vertices.rows()) = vertices;
  Eigen::Index row = vertices.rows();
  for (const EdgePoint& point : points)
    all.row(row++) = (1 - point.share) * vertices.row(point.kept) + point.share * vertices.row(point.removed);
  return all;
}

}  // namespace daumier::geometry
