#include "rig/mesh_weights.h"

#include "core/error.h"
#include "rig/arkit_names.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>

namespace daumier::rig {
namespace {

constexpr int kMostSteps = 30;
constexpr double kStillRadians = 1e-9;

/// A rotation and a translation.
struct RigidMotion {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  geometry::Vector3 translation = geometry::Vector3::Zero();

  geometry::Points Undone(const geometry::Points& points) const {
    return (points.rowwise() - translation.transpose()) * rotation;
  }
};

/// argmin sum_v m_v |R a_v + t - b_v|^2 over rotations [Kabsch 1976].
RigidMotion AlignRigidly(const geometry::Points& a, const geometry::Points& b, const Eigen::VectorXd& masses) {
  const Eigen::RowVector3d centre_a = masses.transpose() * a / masses.sum(),
                           centre_b = masses.transpose() * b / masses.sum();
  const Eigen::Matrix3d covariance =
      (b.rowwise() - centre_b).transpose() * masses.asDiagonal() * (a.rowwise() - centre_a);
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double sign = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1;
  RigidMotion motion;
  motion.rotation = svd.matrixU() * Eigen::Vector3d(1, 1, sign).asDiagonal() * svd.matrixV().transpose();
  motion.translation = centre_b.transpose() - motion.rotation * centre_a.transpose();
  return motion;
}

/// Displacements by small turns about the axes, then by translations: 3V x 6.
Eigen::MatrixXd RigidMotions(const geometry::Points& points) {
  Eigen::MatrixXd motions(points.size(), 6);
  for (Eigen::Index v = 0; v < points.rows(); ++v) {
    const Eigen::Vector3d p = points.row(v);
    for (int axis = 0; axis < 3; ++axis) {
      motions.block<3, 1>(3 * v, axis) = Eigen::Vector3d::Unit(axis).cross(p);
      motions.block<3, 1>(3 * v, 3 + axis) = Eigen::Vector3d::Unit(axis);
    }
  }
  return motions;
}

Eigen::VectorXd Flat(const geometry::Points& points) {
  return Eigen::Map<const Eigen::VectorXd>(points.data(), points.size());
}

}  // namespace

MeshWeights WeightsOfMesh(const WeightSolver& solver, const geometry::Points& rest, const geometry::Points& mesh) {
  DAUMIER_CHECK(rest.rows() == solver.num_vertices() && mesh.rows() == rest.rows(),
                "the mesh has {} vertices, the head at rest {}, its targets {}", mesh.rows(), rest.rows(),
                solver.num_vertices());
  RigidMotion motion =
      AlignRigidly(rest(solver.vertices(), Eigen::all), mesh(solver.vertices(), Eigen::all), solver.masses());
  MeshWeights result;
  result.weights = Eigen::VectorXd::Zero(kNumArkitNames);
  result.at_rest = solver.ErrorOf(Flat(motion.Undone(mesh) - rest), result.weights);
  for (int step = 0; step < kMostSteps; ++step) {
    const geometry::Points undone = motion.Undone(mesh);
    const auto solved = solver.Solve(Flat(undone - rest), RigidMotions(undone));
    result.weights = solved.weights;
    // undone = expression + turn x undone + shift, and so mesh = R (I + [turn]) expression + ...
    const Eigen::Vector3d turn = solved.motions.head<3>(), shift = solved.motions.tail<3>();
    const double angle = turn.norm();
    const Eigen::Matrix3d step_rotation =
        angle > 0 ? Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix() : Eigen::Matrix3d::Identity();
    motion.translation += motion.rotation * shift;
    motion.rotation = motion.rotation * step_rotation;
    if (angle < kStillRadians && shift.norm() < kStillRadians) break;
  }
  result.error = solver.ErrorOf(Flat(motion.Undone(mesh) - rest), result.weights);
  result.rotation = motion.rotation;
  result.translation = motion.translation;
  return result;
}

}  // namespace daumier::rig
