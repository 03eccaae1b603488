#include "rig/transferred_targets.h"

#include "core/error.h"
#include "core/parallel.h"
#include "geometry/deformation_transfer.h"
#include "geometry/submesh.h"
#include "geometry/topology.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <vector>

namespace daumier::rig {
namespace {

constexpr double kStillCm = 1e-3, kUnchangedGradient = 1e-5;
constexpr float kFadeCm = 0.005f;
constexpr double kLeastQuality = 1e-6;  // Twice the area over the square of the longest edge.

geometry::Points PoseOfTarget(const geometry::Points& neutral, const MorphTargets& targets, int t) {
  geometry::Points pose = neutral;
  Eigen::Map<Eigen::VectorXd>(pose.data(), pose.size()) += targets.offsets.col(t).cast<double>();
  return pose;
}

bool HasArea(const geometry::Points& points, const geometry::Triangles& triangles, Eigen::Index f) {
  const geometry::Vector3 a = points.row(triangles(f, 1)) - points.row(triangles(f, 0)),
                          b = points.row(triangles(f, 2)) - points.row(triangles(f, 0));
  const double longest = std::max({a.squaredNorm(), b.squaredNorm(), (a - b).squaredNorm()});
  return a.cross(b).norm() > kLeastQuality * longest;
}

/// Triangles with area on both shapes and in every pose.
geometry::Triangles UsableTriangles(const geometry::TriangleMesh& neutral, const geometry::Points& edited,
                                    const std::vector<geometry::Points>& poses) {
  std::vector<int> rows;
  for (Eigen::Index f = 0; f < neutral.triangles.rows(); ++f) {
    const auto has_area = [&](const geometry::Points& points) { return HasArea(points, neutral.triangles, f); };
    if (has_area(neutral.vertices) && has_area(edited) && std::ranges::all_of(poses, has_area)) rows.push_back(int(f));
  }
  return neutral.triangles(rows, Eigen::all);
}

std::vector<std::vector<int>> MembersOf(const std::vector<int>& labels) {
  std::vector<std::vector<int>> members;
  for (size_t v = 0; v < labels.size(); ++v) {
    members.resize(std::max(members.size(), size_t(labels[v]) + 1));
    members[size_t(labels[v])].push_back(int(v));
  }
  return members;
}

/// Vertices whose targets are solved for, with those that stay, and the scale of all others.
struct TransferPlan {
  geometry::VertexMap solved;
  std::vector<int> pinned;  ///< Of the solved.
  std::vector<float> scales;
};

TransferPlan PlanOf(const geometry::Points& neutral, const geometry::Points& edited,
                    const geometry::Triangles& all_triangles, const geometry::Triangles& usable,
                    const std::vector<int>& still) {
  const int num_vertices = int(neutral.rows());
  TransferPlan plan;
  plan.scales.assign(size_t(num_vertices), 1);
  for (const std::vector<int>& part :
       MembersOf(geometry::ConnectedComponents(geometry::VertexNeighbours(all_triangles, num_vertices)))) {
    const auto scale = float(MeanMotionOf(neutral(part, Eigen::all), edited(part, Eigen::all)).scale);
    for (const int v : part) plan.scales[size_t(v)] = scale;
  }
  const geometry::Adjacency neighbours = geometry::VertexNeighbours(usable, num_vertices);
  std::vector<int> kept;
  for (const std::vector<int>& part : MembersOf(geometry::ConnectedComponents(neighbours))) {
    const auto is_still = [&](int v) { return std::ranges::binary_search(still, v); };
    if (part.size() >= 3 && std::ranges::any_of(part, is_still)) kept.insert(kept.end(), part.begin(), part.end());
  }
  plan.solved = geometry::MapKept(kept, num_vertices);
  plan.pinned = geometry::SelectVertices(still, plan.solved);
  return plan;
}

/// The change of a displacement: less where the vertex had none.
Eigen::Vector3f Damped(const Eigen::Vector3f& old, Eigen::Vector3f change) {
  const float length = change.norm();
  if (old.isZero(0) && length < 2 * kFadeCm) change *= std::max(0.0f, length / kFadeCm - 1);
  return change;
}

}  // namespace

MeanMotion MeanMotionOf(const geometry::Points& from, const geometry::Points& to) {
  DAUMIER_CHECK(from.rows() == to.rows() && from.rows() > 0, "{} points moved to {}", from.rows(), to.rows());
  MeanMotion motion{from.colwise().mean().transpose(), to.colwise().mean().transpose()};
  const double spread = (from.rowwise() - motion.mean_from.transpose()).norm();
  if (spread > 1e-9) motion.scale = (to.rowwise() - motion.mean_to.transpose()).norm() / spread;
  return motion;
}

MorphTargets TransferredTargets(const geometry::TriangleMesh& neutral, const geometry::Points& edited,
                                const MorphTargets& targets) {
  const Eigen::Index num_vertices = neutral.vertices.rows();
  DAUMIER_CHECK(edited.rows() == num_vertices && targets.offsets.rows() == 3 * num_vertices,
                "targets of {} numbers, an edited shape of {} vertices: expected those of {} vertices",
                targets.offsets.rows(), edited.rows(), num_vertices);
  std::vector<geometry::Points> poses;
  for (int t = 0; t < targets.num_targets(); ++t) poses.push_back(PoseOfTarget(neutral.vertices, targets, t));
  const geometry::Triangles usable = UsableTriangles(neutral, edited, poses);
  const TransferPlan plan = PlanOf(neutral.vertices, edited, neutral.triangles, usable,
                                   geometry::StaticVertices(neutral.vertices, poses, kStillCm));
  MorphTargets result = targets;
  for (Eigen::Index v = 0; v < num_vertices; ++v)
    if (plan.solved.new_from_old[size_t(v)] < 0) result.offsets.middleRows<3>(3 * v) *= plan.scales[size_t(v)];
  if (plan.solved.old_from_new.empty() || plan.pinned.size() == plan.solved.old_from_new.size()) return result;

  const auto of_solved = [&](const geometry::Points& points) { return geometry::SelectPoints(points, plan.solved); };
  const geometry::TriangleMesh from{of_solved(neutral.vertices), geometry::SelectTriangles(usable, plan.solved)};
  const geometry::TriangleMesh to{of_solved(edited), from.triangles};
  const geometry::DeformationTransfer onto_neutral(from, plan.pinned), onto_edited(to, plan.pinned);
  OnAllCores(targets.num_targets(), [&](int64_t t) {
    const geometry::DeformationGradients gradients =
        geometry::ComputeDeformationGradients(from, of_solved(poses[size_t(t)]), kUnchangedGradient);
    const geometry::Points change =
        (onto_edited.Apply(gradients) - to.vertices) - (onto_neutral.Apply(gradients) - from.vertices);
    for (size_t i = 0; i < plan.solved.old_from_new.size(); ++i) {
      auto offset = result.offsets.col(t).segment<3>(3 * Eigen::Index(plan.solved.old_from_new[i]));
      offset += Damped(offset, change.row(Eigen::Index(i)).transpose().cast<float>());
    }
  });
  return result;
}

}  // namespace daumier::rig
