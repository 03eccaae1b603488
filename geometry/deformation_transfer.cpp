#include "geometry/deformation_transfer.h"

#include "core/error.h"

namespace daumier::geometry {
namespace {

/// Columns: two edges and the unit normal.
Eigen::Matrix3d Frame(const Points& points, const Triangles& triangles, int f) {
  Eigen::Matrix3d frame;
  frame.col(0) = points.row(triangles(f, 1)) - points.row(triangles(f, 0));
  frame.col(1) = points.row(triangles(f, 2)) - points.row(triangles(f, 0));
  const Vector3 normal = frame.col(0).cross(frame.col(1));
  DAUMIER_CHECK(normal.squaredNorm() > 0, "triangle {} has no area", f);
  frame.col(2) = normal.normalized();
  return frame;
}

}  // namespace

DeformationGradients ComputeDeformationGradients(const TriangleMesh& reference, const Points& deformed,
                                                 double tolerance) {
  DAUMIER_CHECK(deformed.rows() == reference.vertices.rows(), "the reference has {} vertices, its deformation {}",
                reference.vertices.rows(), deformed.rows());
  DeformationGradients gradients;
  for (int f = 0; f < reference.triangles.rows(); ++f) {
    const Eigen::Matrix3d rest = Frame(reference.vertices, reference.triangles, f);
    const Eigen::Matrix3d change =
        (Frame(deformed, reference.triangles, f) - rest) * rest.inverse();  // S - I, exactly 0 where nothing changes
    if (change.cwiseAbs().maxCoeff() <= tolerance) continue;
    gradients.triangles.push_back(f);
    gradients.changes.push_back(change);
  }
  return gradients;
}

std::vector<int> StaticVertices(const Points& reference, const std::vector<Points>& poses, double tolerance) {
  Eigen::VectorXd farthest = Eigen::VectorXd::Zero(reference.rows());
  for (const Points& pose : poses) {
    DAUMIER_CHECK(pose.rows() == reference.rows(), "the reference has {} vertices, a pose {}", reference.rows(),
                  pose.rows());
    farthest = farthest.cwiseMax((pose - reference).rowwise().norm());
  }
  std::vector<int> still;
  for (int v = 0; v < farthest.size(); ++v) {
    if (farthest[v] <= tolerance) still.push_back(v);
  }
  return still;
}

DeformationTransfer::DeformationTransfer(const TriangleMesh& target, const std::vector<int>& pinned_ids)
    : target_(target),
      cotangents_(CornerCotangents(target, kUnclamped)),
      solver_(CotangentLaplacian(target, kUnclamped), pinned_ids),
      still_(Eigen::MatrixXd::Zero(pinned_ids.size(), 3)) {}

Points DeformationTransfer::Apply(const DeformationGradients& gradients) const {
  // The displacement d solves L d = div((S - I) grad x): by corners k of each triangle, with e_k the opposite edge, the
  // two ends of e_k receive -+ 1/2 cot_k (S - I) e_k.
  Eigen::MatrixXd divergence = Eigen::MatrixXd::Zero(target_.vertices.rows(), 3);
  for (size_t i = 0; i < gradients.triangles.size(); ++i) {
    const int f = gradients.triangles[i];
    DAUMIER_CHECK(f >= 0 && f < target_.triangles.rows(), "triangle {} of a deformation is out of range, there are {}",
                  f, target_.triangles.rows());
    for (int k = 0; k < 3; ++k) {
      const int from = target_.triangles(f, (k + 1) % 3), to = target_.triangles(f, (k + 2) % 3);
      const Vector3 edge = target_.vertices.row(to) - target_.vertices.row(from);
      const Eigen::RowVector3d flux = (0.5 * cotangents_(f, k) * (gradients.changes[i] * edge)).transpose();
      divergence.row(to) += flux;
      divergence.row(from) -= flux;
    }
  }
  return target_.vertices + solver_.Solve(divergence, still_);
}

Points TransferDeformation(const TriangleMesh& reference, const Points& deformed, const TriangleMesh& target,
                           const std::vector<int>& pinned_ids) {
  return DeformationTransfer(target, pinned_ids).Apply(ComputeDeformationGradients(reference, deformed));
}

}  // namespace daumier::geometry
