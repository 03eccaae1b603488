#include "geometry/triangle_tree.h"

#include "core/error.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace daumier::geometry {
namespace {

constexpr int kLeafSize = 4;
/// Boxes and triangles are measured along different ways, which may differ by rounding.
constexpr double kSlack = 1 + 1e-12;

}  // namespace

Eigen::AlignedBox3d TriangleBox(const TriangleMesh& mesh, int triangle) {
  Eigen::AlignedBox3d box;
  for (int k = 0; k < 3; ++k) box.extend(mesh.vertices.row(mesh.triangles(triangle, k)).transpose());
  return box;
}

TriangleTree::TriangleTree(TriangleMesh mesh) : mesh_(std::move(mesh)) {
  const int num_triangles = static_cast<int>(mesh_.triangles.rows());
  DAUMIER_CHECK(num_triangles > 0, "a tree needs at least one triangle");
  DAUMIER_CHECK(mesh_.triangles.minCoeff() >= 0 && mesh_.triangles.maxCoeff() < mesh_.vertices.rows(),
                "a triangle names a vertex that is not there: there are {}", mesh_.vertices.rows());
  DAUMIER_CHECK(mesh_.vertices.allFinite(), "a tree needs finite positions");
  std::vector<Eigen::AlignedBox3d> boxes(num_triangles);
  for (int f = 0; f < num_triangles; ++f) boxes[f] = TriangleBox(mesh_, f);
  order_.resize(num_triangles);
  std::iota(order_.begin(), order_.end(), 0);
  Build(0, num_triangles, boxes);
}

int TriangleTree::Build(int begin, int end, const std::vector<Eigen::AlignedBox3d>& boxes) {
  const int index = static_cast<int>(nodes_.size());
  Eigen::AlignedBox3d box, centres;
  for (int i = begin; i < end; ++i) {
    box.extend(boxes[order_[i]]);
    centres.extend(boxes[order_[i]].center());
  }
  nodes_.push_back({box, begin, end});
  if (end - begin <= kLeafSize) return index;
  int axis;
  centres.sizes().maxCoeff(&axis);
  const int middle = (begin + end) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end, [&](int a, int b) {
    return std::pair(boxes[a].center()[axis], a) < std::pair(boxes[b].center()[axis], b);
  });
  Build(begin, middle, boxes);
  const int second = Build(middle, end, boxes);
  nodes_[index].second_child = second;
  return index;
}

SurfacePoint TriangleTree::Closest(const Vector3& point) const {
  SurfacePoint best{-1, Vector3::Zero(), Vector3::Zero(), std::numeric_limits<double>::infinity()};
  struct Visit {
    int node;
    double distance;
  };
  std::vector<Visit> open = {{0, nodes_[0].box.exteriorDistance(point)}};
  while (!open.empty()) {
    const Visit visit = open.back();
    open.pop_back();
    if (visit.distance > best.distance * kSlack) continue;
    const Node& node = nodes_[visit.node];
    if (node.second_child == 0) {
      for (int i = node.begin; i < node.end; ++i) {
        const SurfacePoint candidate = ClosestPointOnTriangle(mesh_, order_[i], point);
        const bool is_better = candidate.distance < best.distance ||
                               (candidate.distance == best.distance && candidate.triangle < best.triangle);
        if (is_better) best = candidate;
      }
      continue;
    }
    Visit near{visit.node + 1, nodes_[visit.node + 1].box.exteriorDistance(point)};
    Visit far{node.second_child, nodes_[node.second_child].box.exteriorDistance(point)};
    if (far.distance < near.distance) std::swap(near, far);
    open.push_back(far);
    open.push_back(near);
  }
  return best;
}

std::vector<int> TriangleTree::Overlapping(const Eigen::AlignedBox3d& box) const {
  std::vector<int> found, open = {0};
  while (!open.empty()) {
    const int index = open.back();
    open.pop_back();
    const Node& node = nodes_[index];
    if (!node.box.intersects(box)) continue;
    if (node.second_child != 0) {
      open.push_back(index + 1);
      open.push_back(node.second_child);
      continue;
    }
    for (int i = node.begin; i < node.end; ++i) {
      if (TriangleBox(mesh_, order_[i]).intersects(box)) found.push_back(order_[i]);
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace daumier::geometry
