#include "geometry/decimation.h"

#include "core/error.h"
#include "geometry/collapse_mesh.h"
#include "geometry/corner_uv.h"
#include "geometry/pose_quadrics.h"
#include "geometry/weld.h"

#include <algorithm>
#include <map>
#include <queue>
#include <tuple>
#include <utility>

namespace daumier::geometry {
namespace {

constexpr float kFeatureWeight = 2;    // Of the planes that hold features.
constexpr float kLengthShare = 1e-4f;  // Of an edge's squared length squared in its cost: decides between flat ones.

/// The first vertex at the same place with the same offsets.
std::vector<int> PlacesOf(const DecimationInput& input) {
  std::vector<int> places = WeldByPlace(input.mesh.vertices, WeldTolerance(input.mesh.vertices));
  for (int v = 0; v < std::ssize(places); ++v) {
    const int place = places[size_t(v)];
    if (place != v && input.offsets.cols() > 0 &&
        input.offsets.middleRows<3>(3 * v) != input.offsets.middleRows<3>(3 * place))
      places[size_t(v)] = v;
  }
  return places;
}

/// For each row of UV the first one with its values.
std::vector<int> UniqueUv(const TextureCoordinates& uv) {
  std::map<std::pair<double, double>, int> first;
  std::vector<int> unique;
  for (int row = 0; row < uv.rows(); ++row)
    unique.push_back(first.try_emplace({uv(row, 0), uv(row, 1)}, row).first->second);
  return unique;
}

/// A place with a row of UV.
struct Wedge {
  int vertex, uv;
};

/// Corners as places and wedges, without triangles that have a place twice.
struct Corners {
  Triangles places, wedges;
  std::vector<int> rows;  ///< Of the input.
  std::vector<Wedge> table;
};

Corners WedgedCornersOf(const TriangleMesh& mesh, const std::vector<int>& places) {
  Corners corners;
  const std::vector<int> unique_uv = UniqueUv(mesh.uv);
  std::map<std::pair<int, int>, int> numbers;
  std::vector<Eigen::Vector3i> of_places, of_wedges;
  for (int f = 0; f < mesh.triangles.rows(); ++f) {
    Eigen::Vector3i place, wedge;
    for (int k = 0; k < 3; ++k) {
      const int v = mesh.triangles(f, k), uv = mesh.has_uv() ? unique_uv[size_t(mesh.uv_triangles(f, k))] : -1;
      DAUMIER_CHECK(v >= 0 && v < mesh.vertices.rows(), "triangle {} names vertex {}, there are {}", f, v,
                    mesh.vertices.rows());
      place[k] = places[size_t(v)];
      const auto [entry, is_new] = numbers.try_emplace({place[k], uv}, int(corners.table.size()));
      if (is_new) corners.table.push_back({place[k], uv});
      wedge[k] = entry->second;
    }
    if (place[0] == place[1] || place[1] == place[2] || place[2] == place[0]) continue;
    of_places.push_back(place);
    of_wedges.push_back(wedge);
    corners.rows.push_back(f);
  }
  corners.places.resize(std::ssize(of_places), 3);
  corners.wedges.resize(std::ssize(of_places), 3);
  for (size_t i = 0; i < of_places.size(); ++i) {
    corners.places.row(Eigen::Index(i)) = of_places[i].transpose();
    corners.wedges.row(Eigen::Index(i)) = of_wedges[i].transpose();
  }
  return corners;
}

template <class T>
std::vector<T> Selected(const std::vector<T>& values, const std::vector<int>& rows) {
  std::vector<T> selected;
  if (!values.empty())
    for (const int row : rows) selected.push_back(values[size_t(row)]);
  return selected;
}

class Decimator {
 public:
  explicit Decimator(const DecimationInput& input)
      : input_(input),
        places_(PlacesOf(input)),
        corners_(WedgedCornersOf(input.mesh, places_)),
        mesh_(corners_.places, corners_.wedges, Selected(input.labels, corners_.rows), int(input.mesh.vertices.rows())),
        quadrics_(input.mesh.vertices, input.offsets),
        stamps_(places_.size(), 0),
        is_kept_(places_.size(), false) {
    for (const int v : input.kept) is_kept_[size_t(places_[size_t(v)])] = true;
    const auto importance = [&](int f) {
      return input.importance.empty() ? 1 : input.importance[size_t(corners_.rows[size_t(f)])];
    };
    for (int f = 0; f < corners_.places.rows(); ++f) {
      const auto t = corners_.places.row(f);
      quadrics_.AddTriangle(t[0], t[1], t[2], importance(f));
    }
    for (const FeatureEdge& edge : mesh_.FeatureEdges())
      quadrics_.AddEdge(edge.from, edge.to, edge.opposite, kFeatureWeight * importance(edge.triangle));
    for (int v = 0; v < std::ssize(places_); ++v) Update(v);
  }

  void Run(int num_triangles) {
    while (mesh_.num_triangles() > num_triangles && !queue_.empty()) {
      const Candidate candidate = queue_.top();
      queue_.pop();
      if (candidate.stamp != stamps_[size_t(candidate.from)]) continue;
      const std::optional<EdgeCollapse> collapse = Checked(candidate.from, candidate.to);
      if (collapse) {
        Apply(*collapse);
      } else {
        PushNext(candidate);
      }
    }
  }

  DecimatedSurface Result(int num_triangles) const {
    DecimatedSurface result;
    result.is_reached = mesh_.num_triangles() <= num_triangles;
    result.triangles.resize(mesh_.num_triangles(), 3);
    result.uv_triangles.resize(input_.mesh.has_uv() ? mesh_.num_triangles() : 0, 3);
    for (int f = 0; f < mesh_.triangles().rows(); ++f) {
      if (!mesh_.IsAlive(f)) continue;
      const Eigen::Index row = std::ssize(result.rows);
      for (int k = 0; k < 3; ++k) {
        const Wedge& wedge = corners_.table[size_t(mesh_.wedges()(f, k))];
        result.triangles(row, k) = wedge.vertex;
        if (input_.mesh.has_uv()) result.uv_triangles(row, k) = wedge.uv;
      }
      result.rows.push_back(corners_.rows[size_t(f)]);
    }
    return result;
  }

 private:
  struct Candidate {
    float cost;
    int from, to, stamp;
    /// The cheapest first; equal ones in a fixed order.
    bool operator<(const Candidate& other) const {
      return std::tie(other.cost, other.from, other.to) < std::tie(cost, from, to);
    }
  };

  float CostOf(int from, int to) const {
    const auto squared = float((input_.mesh.vertices.row(from) - input_.mesh.vertices.row(to)).squaredNorm());
    return quadrics_.Cost(from, to) + kLengthShare * squared * squared;
  }

  /// The cheapest collapse of a vertex.
  void Update(int vertex) {
    ++stamps_[size_t(vertex)];
    if (is_kept_[size_t(vertex)] || mesh_.TrianglesAt(vertex).empty()) return;
    Candidate best{0, vertex, -1, stamps_[size_t(vertex)]};
    for (const int to : mesh_.Targets(vertex)) {
      const float cost = CostOf(vertex, to);
      if (best.to < 0 || std::pair(cost, to) < std::pair(best.cost, best.to)) best.cost = cost, best.to = to;
    }
    if (best.to >= 0) queue_.push(best);
  }

  /// The next cheapest one after a collapse that is not permitted as the surface is now.
  void PushNext(const Candidate& refused) {
    Candidate best = refused;
    best.to = -1;
    for (const int to : mesh_.Targets(refused.from)) {
      const float cost = CostOf(refused.from, to);
      if (std::pair(cost, to) <= std::pair(refused.cost, refused.to)) continue;
      if (best.to < 0 || std::pair(cost, to) < std::pair(best.cost, best.to)) best.cost = cost, best.to = to;
    }
    if (best.to >= 0) queue_.push(best);
  }

  std::optional<EdgeCollapse> Checked(int from, int to) const {
    std::optional<EdgeCollapse> collapse = mesh_.Plan(from, to);
    if (!collapse) return std::nullopt;
    for (const int f : mesh_.TrianglesAt(from)) {
      const auto t = mesh_.triangles().row(f);
      int k = 0;
      while (t[k] != from) ++k;
      const int a = t[(k + 1) % 3], b = t[(k + 2) % 3];
      if (a == to || b == to) continue;
      if (!quadrics_.MayMove(from, to, a, b) || TurnsOverInUv(*collapse, f, k)) return std::nullopt;
    }
    return collapse;
  }

  bool TurnsOverInUv(const EdgeCollapse& collapse, int f, int corner) const {
    if (!input_.mesh.has_uv()) return false;
    const auto uv = [&](int wedge) -> Eigen::RowVector2d {
      return input_.mesh.uv.row(corners_.table[size_t(wedge)].uv);
    };
    const int wedge = mesh_.wedges()(f, corner);
    const Eigen::RowVector2d a = uv(mesh_.wedges()(f, (corner + 1) % 3)), b = uv(mesh_.wedges()(f, (corner + 2) % 3));
    const auto moved = std::ranges::find(collapse.wedges, wedge, &std::pair<int, int>::first);
    const auto area = [&](const Eigen::RowVector2d& p) {
      return (b - a).x() * (p - a).y() - (b - a).y() * (p - a).x();
    };
    return area(uv(wedge)) * area(uv(moved->second)) < 0;
  }

  void Apply(const EdgeCollapse& collapse) {
    quadrics_.Merge(collapse.from, collapse.to);
    mesh_.Apply(collapse);
    ++stamps_[size_t(collapse.from)];
    Update(collapse.to);
    for (const int v : mesh_.Neighbours(collapse.to)) Update(v);
  }

  const DecimationInput& input_;
  std::vector<int> places_;
  Corners corners_;
  CollapseMesh mesh_;
  PoseQuadrics quadrics_;
  std::vector<int> stamps_;
  std::vector<bool> is_kept_;
  std::priority_queue<Candidate> queue_;
};

}  // namespace

DecimatedSurface Decimate(const DecimationInput& input, int num_triangles) {
  CheckUv(input.mesh);
  const Eigen::Index count = input.mesh.triangles.rows();
  DAUMIER_CHECK(input.labels.empty() || std::ssize(input.labels) == count, "{} labels for {} triangles",
                input.labels.size(), count);
  DAUMIER_CHECK(input.importance.empty() || std::ssize(input.importance) == count, "{} importances for {} triangles",
                input.importance.size(), count);
  for (const int v : input.kept)
    DAUMIER_CHECK(v >= 0 && v < input.mesh.vertices.rows(), "vertex {} is to be kept, there are {}", v,
                  input.mesh.vertices.rows());
  Decimator decimator(input);
  decimator.Run(num_triangles);
  return decimator.Result(num_triangles);
}

}  // namespace daumier::geometry
