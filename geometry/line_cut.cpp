#include "geometry/line_cut.h"

#include "core/error.h"
#include "geometry/corner_uv.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace daumier::geometry {
namespace {

using Edge = std::pair<int, int>;

Edge EdgeOf(int a, int b) {
  return std::minmax(a, b);
}

/// Where a line crosses a mesh: signs of its vertices, 0 on the line, and points of crossed edges.
struct Crossings {
  std::vector<int> signs;
  std::vector<bool> is_on_line;  ///< Of vertices.
  std::map<Edge, EdgePoint> points;
};

int SignOf(double value) {
  return value > 0 ? 1 : value < 0 ? -1 : 0;
}

/// Calls visit(a, b), a < b, for each corner pair of triangles; edges between triangles come twice.
template <class Visit>
void ForEdges(const Triangles& triangles, Visit&& visit) {
  for (const auto& t : triangles.rowwise())
    for (int k = 0; k < 3; ++k) visit(std::min(t[k], t[(k + 1) % 3]), std::max(t[k], t[(k + 1) % 3]));
}

EdgePoint ZeroOf(int a, int b, const Eigen::VectorXd& values) {
  return {a, b, std::abs(values[a]) / (std::abs(values[a]) + std::abs(values[b]))};
}

/// Of three corners on the line the one that is farthest from it leaves it.
void LeaveTriangles(const Triangles& triangles, const Eigen::VectorXd& values, Crossings& crossings) {
  for (const auto& t : triangles.rowwise()) {
    if (!std::ranges::all_of(t, [&](int v) { return crossings.signs[size_t(v)] == 0; })) continue;
    int farthest = t[0];
    for (const int v : t)
      if (std::abs(values[v]) > std::abs(values[farthest])) farthest = v;
    crossings.signs[size_t(farthest)] = SignOf(values[farthest]);
    if (values[farthest] != 0) crossings.is_on_line[size_t(farthest)] = false;
  }
}

Crossings FindCrossings(const TriangleMesh& mesh, const Eigen::VectorXd& values,
                        const std::function<bool(const EdgePoint&)>& is_on_line) {
  Crossings crossings;
  for (int v = 0; v < int(values.size()); ++v) {
    crossings.signs.push_back(SignOf(values[v]));
    crossings.is_on_line.push_back(values[v] == 0 && is_on_line({v, v, 0}));
  }
  ForEdges(mesh.triangles, [&](int a, int b) {
    if (values[a] * values[b] >= 0) return;
    const EdgePoint zero = ZeroOf(a, b, values);
    const int end = zero.share < kSnapShare ? a : zero.share > 1 - kSnapShare ? b : -1;
    if (end < 0 || !is_on_line(zero)) return;
    crossings.signs[size_t(end)] = 0;
    crossings.is_on_line[size_t(end)] = true;
  });
  LeaveTriangles(mesh.triangles, values, crossings);
  ForEdges(mesh.triangles, [&](int a, int b) {
    if (crossings.signs[size_t(a)] * crossings.signs[size_t(b)] >= 0) return;
    const EdgePoint zero = ZeroOf(a, b, values);
    if (is_on_line(zero)) crossings.points.emplace(Edge(a, b), zero);
  });
  return crossings;
}

class LineCutter {
 public:
  LineCutter(const TriangleMesh& mesh, Crossings crossings)
      : mesh_(mesh), crossings_(std::move(crossings)), num_vertices_(int(mesh.vertices.rows())) {
    for (const auto& row : mesh.uv.rowwise()) uv_.push_back(row);
  }

  LineCut Cut() && {
    for (const auto& [edge, point] : crossings_.points) {
      row_of_edge_.emplace(edge, int(points_.size()));
      points_.push_back(point);
    }
    pieces_.resize(size_t(mesh_.triangles.rows()));
    for (int t = 0; t < mesh_.triangles.rows(); ++t) Split(t);
    cut_.mesh.vertices = WithEdgePoints(mesh_.vertices, points_);
    FindEdges();
    Open();
    return Finished();
  }

 private:
  struct Corner {
    int vertex, uv;
  };
  struct Piece {
    std::array<Corner, 3> corners;
    int source, sign;
  };

  /// The point on the edge from a corner to the next one.
  Corner CornerOn(int row, const Corner& a, const Corner& b) {
    const int vertex = num_vertices_ + row;
    if (!mesh_.has_uv()) return {vertex, 0};
    const EdgePoint& point = points_[size_t(row)];
    const Corner &kept = point.kept == a.vertex ? a : b, &removed = point.kept == a.vertex ? b : a;
    const auto [entry, is_new] = uv_of_edge_.emplace(std::array{row, kept.uv, removed.uv}, int(uv_.size()));
    if (is_new) uv_.push_back((1 - point.share) * uv_[size_t(kept.uv)] + point.share * uv_[size_t(removed.uv)]);
    return {vertex, entry->second};
  }

  /// That of all corners that have one; 0 if they disagree.
  int SignOfPiece(const std::array<Corner, 3>& corners) const {
    int sign = 0;
    for (const Corner& corner : corners) {
      const int own = corner.vertex < num_vertices_ ? crossings_.signs[size_t(corner.vertex)] : 0;
      if (own * sign < 0) return 0;
      if (own != 0) sign = own;
    }
    return sign;
  }

  void Add(int source, bool is_first, const std::array<Corner, 3>& corners) {
    const Piece piece{corners, source, SignOfPiece(corners)};
    if (is_first) {
      pieces_[size_t(source)] = piece;
    } else {
      pieces_.push_back(piece);
    }
  }

  void Split(int t) {
    std::array<Corner, 3> corners{};
    std::array<int, 3> rows{};  // Of the points on the edges that begin at the corners.
    int num_crossed = 0, last_crossed = 0, whole = 0;
    for (int k = 0; k < 3; ++k) {
      corners[size_t(k)] = {mesh_.triangles(t, k), mesh_.has_uv() ? mesh_.uv_triangles(t, k) : 0};
      const auto found = row_of_edge_.find(EdgeOf(mesh_.triangles(t, k), mesh_.triangles(t, (k + 1) % 3)));
      rows[size_t(k)] = found == row_of_edge_.end() ? -1 : found->second;
      if (rows[size_t(k)] < 0) whole = k;
      if (rows[size_t(k)] >= 0) last_crossed = k, ++num_crossed;
    }
    if (num_crossed == 0) return Add(t, true, corners);
    if (num_crossed == 1) {
      const Corner &a = corners[size_t(last_crossed)], &b = corners[size_t(last_crossed + 1) % 3],
                   &c = corners[size_t(last_crossed + 2) % 3];
      const Corner point = CornerOn(rows[size_t(last_crossed)], a, b);
      Add(t, true, {a, point, c});
      return Add(t, false, {point, b, c});
    }
    const Corner &a = corners[size_t(whole)], &b = corners[size_t(whole + 1) % 3], &c = corners[size_t(whole + 2) % 3];
    const Corner on_bc = CornerOn(rows[size_t(whole + 1) % 3], b, c),
                 on_ca = CornerOn(rows[size_t(whole + 2) % 3], c, a);
    Add(t, true, {c, on_ca, on_bc});
    Add(t, false, {a, b, on_bc});
    Add(t, false, {a, on_bc, on_ca});
  }

  bool IsOnLine(int vertex) const { return vertex >= num_vertices_ || crossings_.is_on_line[size_t(vertex)]; }

  /// Edges between vertices of the line, with a triangle below and one above.
  void FindEdges() {
    std::map<Edge, std::array<int, 2>> triangles;  // Below, above.
    for (size_t t = 0; t < pieces_.size(); ++t) {
      const Piece& piece = pieces_[t];
      for (size_t k = 0; piece.sign != 0 && k < 3; ++k) {
        const int a = piece.corners[k].vertex, b = piece.corners[(k + 1) % 3].vertex;
        if (!IsOnLine(a) || !IsOnLine(b)) continue;
        triangles.try_emplace(EdgeOf(a, b), std::array{-1, -1}).first->second[piece.sign > 0 ? 1 : 0] = int(t);
      }
    }
    for (const auto& [edge, sides] : triangles) {
      if (sides[0] < 0 || sides[1] < 0) continue;
      cut_edges_.insert(edge);
      const Piece& below = pieces_[size_t(sides[0])];
      const bool is_forward =
          std::ranges::any_of(std::array<size_t, 3>{0, 1, 2}, [&, from = edge.first, to = edge.second](size_t k) {
            return below.corners[k].vertex == from && below.corners[(k + 1) % 3].vertex == to;
          });
      const int first = RimOf(edge.first), second = RimOf(edge.second);
      cut_.edges.push_back({is_forward ? first : second, is_forward ? second : first, sides[0], sides[1]});
      cut_.length += (cut_.mesh.vertices.row(edge.first) - cut_.mesh.vertices.row(edge.second)).norm();
    }
  }

  int RimOf(int vertex) {
    const auto [entry, is_new] = rim_of_vertex_.emplace(vertex, int(cut_.rim.size()));
    if (is_new) cut_.rim.push_back({vertex, vertex});
    return entry->second;
  }

  /// Gives what is above the line vertices of its own.
  void Open() {
    std::vector<std::vector<int>> around(cut_.rim.size());
    for (size_t t = 0; t < pieces_.size(); ++t)
      for (const Corner& corner : pieces_[t].corners)
        if (const auto found = rim_of_vertex_.find(corner.vertex); found != rim_of_vertex_.end())
          around[size_t(found->second)].push_back(int(t));
    std::vector<std::pair<int, int>> moved;  // A triangle and a row of the rim.
    for (size_t r = 0; r < cut_.rim.size(); ++r)
      for (const int t : Above(cut_.rim[r].below, around[r])) moved.emplace_back(t, int(r));
    int num_vertices = int(cut_.mesh.vertices.rows());
    for (const auto& [t, r] : moved) {
      RimVertex& place = cut_.rim[size_t(r)];
      if (place.above == place.below) place.above = num_vertices++;
      for (Corner& corner : pieces_[size_t(t)].corners)
        if (corner.vertex == place.below) corner.vertex = place.above;
    }
    cut_.mesh.vertices.conservativeResize(num_vertices, 3);
    for (const RimVertex& place : cut_.rim)
      cut_.mesh.vertices.row(place.above) = cut_.mesh.vertices.row(place.below).eval();
  }

  bool AreJoined(int vertex, const Piece& a, const Piece& b) const {
    for (const Corner& corner : a.corners) {
      if (corner.vertex == vertex || cut_edges_.contains(EdgeOf(vertex, corner.vertex))) continue;
      for (const Corner& other : b.corners)
        if (other.vertex == corner.vertex) return true;
    }
    return false;
  }

  /// The triangles of the fans at a vertex that are above the line and do not reach below it around an end.
  std::vector<int> Above(int vertex, const std::vector<int>& around) const {
    std::vector<int> above;
    std::vector<bool> is_done(around.size(), false);
    for (size_t first = 0; first < around.size(); ++first) {
      if (is_done[first]) continue;
      std::vector<size_t> fan = {first};
      is_done[first] = true;
      for (size_t i = 0; i < fan.size(); ++i)
        for (size_t j = 0; j < around.size(); ++j)
          if (!is_done[j] && AreJoined(vertex, pieces_[size_t(around[fan[i]])], pieces_[size_t(around[j])])) {
            is_done[j] = true;
            fan.push_back(j);
          }
      const auto has = [&](int sign) {
        return std::ranges::any_of(fan, [&](size_t i) { return pieces_[size_t(around[i])].sign == sign; });
      };
      if (!has(1) || has(-1)) continue;
      for (const size_t i : fan) above.push_back(around[i]);
    }
    return above;
  }

  LineCut Finished() {
    const auto num_triangles = Eigen::Index(pieces_.size());
    cut_.mesh.triangles.resize(num_triangles, 3);
    cut_.mesh.uv.resize(Eigen::Index(uv_.size()), 2);
    for (size_t i = 0; i < uv_.size(); ++i) cut_.mesh.uv.row(Eigen::Index(i)) = uv_[i];
    cut_.mesh.uv_triangles.resize(mesh_.has_uv() ? num_triangles : 0, 3);
    for (Eigen::Index t = 0; t < num_triangles; ++t) {
      const Piece& piece = pieces_[size_t(t)];
      cut_.sources.push_back(piece.source);
      for (int k = 0; k < 3; ++k) {
        cut_.mesh.triangles(t, k) = piece.corners[size_t(k)].vertex;
        if (mesh_.has_uv()) cut_.mesh.uv_triangles(t, k) = piece.corners[size_t(k)].uv;
      }
    }
    return std::move(cut_);
  }

  const TriangleMesh& mesh_;
  const Crossings crossings_;
  const int num_vertices_;
  std::vector<EdgePoint> points_;
  std::map<Edge, int> row_of_edge_;
  std::vector<Eigen::RowVector2d> uv_;
  std::map<std::array<int, 3>, int> uv_of_edge_;  ///< By point, and rows of its ends.
  std::vector<Piece> pieces_;
  std::set<Edge> cut_edges_;
  std::map<int, int> rim_of_vertex_;
  LineCut cut_;
};

}  // namespace

LineCut CutAlongLine(const TriangleMesh& mesh, const Eigen::VectorXd& values,
                     const std::function<bool(const EdgePoint&)>& is_on_line) {
  DAUMIER_CHECK(values.size() == mesh.vertices.rows(), "{} values were given for {} vertices", values.size(),
                mesh.vertices.rows());
  DAUMIER_CHECK(values.allFinite(), "the values of a line to cut along are not all finite");
  CheckUv(mesh);
  return LineCutter(mesh, FindCrossings(mesh, values, is_on_line)).Cut();
}

}  // namespace daumier::geometry
