#include "rig/edited_head.h"

#include "geometry/nearest.h"
#include "geometry/topology.h"
#include "rig/transferred_targets.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

namespace daumier::rig {
namespace {

constexpr double kReachOfLids = 1.3;  // In radii of an eyeball.
constexpr double kMillimetres = 10;   // In a cm.
constexpr Eigen::Index kNearShare = 20, kLeastRows = 6;

/// The matched vertices of the head's mesh, before and after.
struct MovedVertices {
  std::vector<int> vertices;
  geometry::Points from, to;
  geometry::VertexTree tree;

  MovedVertices(const RiggedHead& head, const EditedMatch& match)
      : vertices(MatchedVertices(head, match)),
        from(head.mesh.vertices(vertices, Eigen::all)),
        to(match.places(vertices, Eigen::all)),
        tree(from) {}

  geometry::Vector3 NearestMove(const geometry::Vector3& point) const {
    const int row = tree.Nearest(point).vertex;
    return (to.row(row) - from.row(row)).transpose();
  }
  MeanMotion Motion(const std::vector<int>& rows) const {
    return MeanMotionOf(from(rows, Eigen::all), to(rows, Eigen::all));
  }

 private:
  static std::vector<int> MatchedVertices(const RiggedHead& head, const EditedMatch& match) {
    std::vector<int> matched;
    for (int v = 0; v < head.mesh.vertices.rows(); ++v)
      if (match.is_matched[size_t(v)]) matched.push_back(v);
    return matched;
  }
};

/// The twentieth of the matched vertices that is nearest, ascending; at least kLeastRows, or all of fewer.
std::vector<int> RowsAround(const MovedVertices& moved, const geometry::Vector3& point) {
  std::vector<int> rows(size_t(moved.from.rows()));
  std::iota(rows.begin(), rows.end(), 0);
  const Eigen::VectorXd distances = (moved.from.rowwise() - point.transpose()).rowwise().squaredNorm();
  const auto count = std::min(std::max(moved.from.rows() / kNearShare, kLeastRows), moved.from.rows());
  std::ranges::nth_element(rows, rows.begin() + count - 1, {}, [&](int i) { return distances[i]; });
  rows.resize(size_t(count));
  std::ranges::sort(rows);
  return rows;
}

/// Of the matched vertices that are nearest to points; if these are few, of those around them.
MeanMotion MotionAround(const MovedVertices& moved, const geometry::Points& points) {
  std::vector<int> rows;
  for (const auto& point : points.rowwise()) rows.push_back(moved.tree.Nearest(point.transpose()).vertex);
  std::ranges::sort(rows);
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  if (std::ssize(rows) < kLeastRows) rows = RowsAround(moved, points.colwise().mean().transpose());
  return moved.Motion(rows);
}

/// The vertices of all parts of the mesh, those without a match moved with the others; counts them.
void PlaceAllVertices(const MovedVertices& moved, const EditedMatch& match, EditedHead& result) {
  geometry::Points& vertices = result.head.mesh.vertices;
  const int num_vertices = int(vertices.rows());
  vertices = match.places.topRows(num_vertices);
  const std::vector<int> labels =
      geometry::ConnectedComponents(geometry::VertexNeighbours(result.head.mesh.triangles, num_vertices));
  std::vector<std::vector<int>> without(size_t(*std::ranges::max_element(labels)) + 1);
  std::vector<int> num_matched(without.size(), 0);
  for (int v = 0; v < num_vertices; ++v) {
    const auto label = size_t(labels[size_t(v)]);
    num_matched[label] += match.is_matched[size_t(v)] ? 1 : 0;
    if (!match.is_matched[size_t(v)]) without[label].push_back(v);
  }
  for (size_t part = 0; part < without.size(); ++part) {
    if (num_matched[part] > 0) {
      result.num_expected += num_matched[part] + int(without[part].size());
      result.num_missing += int(without[part].size());
    }
    if (without[part].empty()) continue;
    if (num_matched[part] > 0) {
      for (const int v : without[part]) vertices.row(v) += moved.NearestMove(vertices.row(v).transpose()).transpose();
      continue;
    }
    const MeanMotion motion = MotionAround(moved, vertices(without[part], Eigen::all));
    for (const int v : without[part]) vertices.row(v) = motion.Apply(vertices.row(v).transpose()).transpose();
  }
}

void MoveEye(const EditedMatch& match, const MovedVertices& moved, Eigen::Index first, RiggedEye& eye) {
  const Eigen::Index count = eye.mesh.vertices.rows();
  Eigen::Index num_matched = 0;
  for (Eigen::Index i = 0; i < count; ++i) num_matched += match.is_matched[size_t(first + i)] ? 1 : 0;
  const geometry::Points before = eye.mesh.vertices.rowwise() + eye.centre.transpose();
  if (10 * num_matched >= 9 * count) {
    const geometry::Points after = match.places.middleRows(first, count);
    if (after == before) return;
    eye.centre = MeanMotionOf(before, after).Apply(eye.centre);
    eye.mesh.vertices = after.rowwise() - eye.centre.transpose();
    return;
  }
  const double reach = kReachOfLids * eye.mesh.vertices.rowwise().norm().maxCoeff();
  std::vector<int> lids;
  for (Eigen::Index i = 0; i < moved.from.rows(); ++i)
    if ((moved.from.row(i).transpose() - eye.centre).norm() < reach) lids.push_back(int(i));
  const MeanMotion motion = moved.Motion(std::ssize(lids) < kLeastRows ? RowsAround(moved, eye.centre) : lids);
  eye.centre = motion.Apply(eye.centre);
  eye.mesh.vertices *= motion.scale;
}

void StateChanges(const RiggedHead& before, const MovedVertices& moved, EditedHead& result) {
  const Eigen::VectorXd moves = (moved.to - moved.from).rowwise().norm();
  result.mean_edit_mm = kMillimetres * moves.mean();
  result.most_edit_mm = kMillimetres * moves.maxCoeff();
  for (Eigen::Index t = 0; t < before.targets.offsets.cols(); ++t) {
    for (Eigen::Index v = 0; v < before.mesh.vertices.rows(); ++v) {
      const auto of_vertex = [&](const RiggedHead& head) { return head.targets.offsets.col(t).segment<3>(3 * v); };
      const double change = kMillimetres * double((of_vertex(result.head) - of_vertex(before)).norm());
      if (change <= result.most_target_change_mm) continue;
      result.most_target_change_mm = change;
      result.most_changed_target = before.targets.names[size_t(t)];
    }
  }
}

}  // namespace

EditedHead ApplyEdit(const RiggedHead& head, const EditedMatch& match) {
  const MovedVertices moved(head, match);
  EditedHead result{.head = head};
  result.num_matched = int(std::ranges::count(match.is_matched, true));
  PlaceAllVertices(moved, match, result);
  Eigen::Index first = head.mesh.vertices.rows();
  for (RiggedEye& eye : result.head.eyes) {
    const Eigen::Index count = eye.mesh.vertices.rows();
    MoveEye(match, moved, first, eye);
    first += count;
  }
  result.head.head_pivot = moved.Motion(RowsAround(moved, head.head_pivot)).Apply(head.head_pivot);
  result.head.jaw_pivot = moved.Motion(RowsAround(moved, head.jaw_pivot)).Apply(head.jaw_pivot);
  for (HeadAttachment& attachment : result.head.attachments)
    for (auto vertex : attachment.mesh.vertices.rowwise()) vertex += moved.NearestMove(vertex.transpose()).transpose();
  if (head.targets.num_targets() > 0)
    result.head.targets = TransferredTargets(head.mesh, result.head.mesh.vertices, head.targets);
  StateChanges(head, moved, result);
  return result;
}

}  // namespace daumier::rig
