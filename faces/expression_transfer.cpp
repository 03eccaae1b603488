#include "faces/expression_transfer.h"

#include "core/error.h"
#include "core/parallel.h"

namespace daumier::faces {
namespace {

constexpr double kPinnedCm = 1e-3;
constexpr double kUnchanged = 1e-5;  // Of a deformation gradient: what a rounding of the source's files leaves.

geometry::Points VerticesOf(const FaceModel& model, const Expression& expression) {
  const Eigen::VectorXf offset = ExpressionOffset(model, expression.weights);
  geometry::Points pose = model.face_template.neutral;
  Eigen::Map<Eigen::VectorXd>(pose.data(), pose.size()) += offset.cast<double>();
  return pose;
}

}  // namespace

ExpressionTransfer::ExpressionTransfer(const FaceModel& model, const std::vector<Expression>& expressions)
    : triangles_(model.face_template.triangles), num_vertices_(model.face_template.num_vertices()) {
  const geometry::TriangleMesh rest{model.face_template.neutral, triangles_};
  std::vector<geometry::Points> poses;
  for (const Expression& expression : expressions) {
    poses.push_back(VerticesOf(model, expression));
    gradients_.push_back(geometry::ComputeDeformationGradients(rest, poses.back(), kUnchanged));
  }
  pinned_ = geometry::StaticVertices(rest.vertices, poses, kPinnedCm);
  if (!pinned_.empty()) return;
  linear_offsets_.resize(model.expression_shapes.rows(), expressions.size());
  for (size_t e = 0; e < expressions.size(); ++e)
    linear_offsets_.col(Eigen::Index(e)) = ExpressionOffset(model, expressions[e].weights);
}

Eigen::MatrixXf ExpressionTransfer::Offsets(const geometry::Points& neutral, unsigned max_threads) const {
  return Offsets(neutral, std::vector<bool>(gradients_.size(), true), max_threads);
}

Eigen::MatrixXf ExpressionTransfer::Offsets(const geometry::Points& neutral, const std::vector<bool>& wanted,
                                            unsigned max_threads) const {
  DAUMIER_CHECK(neutral.rows() == num_vertices_, "the face has {} vertices, its template {}", neutral.rows(),
                num_vertices_);
  DAUMIER_CHECK(wanted.size() == gradients_.size(), "{} of {} expressions are wanted or not", wanted.size(),
                gradients_.size());
  if (pinned_.empty()) {
    Eigen::MatrixXf offsets = linear_offsets_;
    for (size_t e = 0; e < wanted.size(); ++e)
      if (!wanted[e]) offsets.col(Eigen::Index(e)).setZero();
    return offsets;
  }
  if (static_cast<Eigen::Index>(pinned_.size()) == num_vertices_)
    return Eigen::MatrixXf::Zero(3 * num_vertices_, num_expressions());
  const geometry::DeformationTransfer transfer({neutral, triangles_}, pinned_);
  Eigen::MatrixXf offsets(3 * num_vertices_, num_expressions());
  int column = 0;
  ForEachInOrder(
      num_expressions(),
      [&](int e) -> geometry::Points {
        if (!wanted[size_t(e)] || gradients_[size_t(e)].triangles.empty())
          return geometry::Points::Zero(num_vertices_, 3);
        return transfer.Apply(gradients_[e]) - neutral;
      },
      [&](const geometry::Points& offset) {
        offsets.col(column++) = Eigen::Map<const Eigen::VectorXd>(offset.data(), offset.size()).cast<float>();
      },
      max_threads);
  return offsets;
}

ExpressionTransfer::Target ExpressionTransfer::On(const geometry::Points& neutral) const {
  DAUMIER_CHECK(neutral.rows() == num_vertices_, "the face has {} vertices, its template {}", neutral.rows(),
                num_vertices_);
  Target target;
  target.transfer_ = this;
  target.neutral_ = neutral;
  if (!pinned_.empty() && static_cast<Eigen::Index>(pinned_.size()) < num_vertices_)
    target.solver_.emplace(geometry::TriangleMesh{neutral, triangles_}, pinned_);
  return target;
}

geometry::Points ExpressionTransfer::Target::Face(const Eigen::VectorXf& weights) const {
  DAUMIER_CHECK(weights.size() == transfer_->num_expressions(), "{} weights of {} expressions", weights.size(),
                transfer_->num_expressions());
  geometry::Points face = neutral_;
  if (transfer_->pinned_.empty()) {
    const Eigen::VectorXf offset = transfer_->linear_offsets_ * weights;
    Eigen::Map<Eigen::VectorXd>(face.data(), face.size()) += offset.cast<double>();
    return face;
  }
  if (!solver_ || weights.isZero(0)) return face;
  // A transfer is linear in the changes of the triangles.
  const auto num_triangles = static_cast<size_t>(transfer_->triangles_.rows());
  std::vector<Eigen::Matrix3d> sums(num_triangles, Eigen::Matrix3d::Zero());
  std::vector<bool> is_changed(num_triangles);
  for (Eigen::Index e = 0; e < weights.size(); ++e) {
    if (weights[e] == 0) continue;
    const geometry::DeformationGradients& gradients = transfer_->gradients_[size_t(e)];
    for (size_t i = 0; i < gradients.triangles.size(); ++i) {
      const auto triangle = static_cast<size_t>(gradients.triangles[i]);
      sums[triangle] += double(weights[e]) * gradients.changes[i];
      is_changed[triangle] = true;
    }
  }
  geometry::DeformationGradients mix;
  for (size_t triangle = 0; triangle < num_triangles; ++triangle) {
    if (!is_changed[triangle]) continue;
    mix.triangles.push_back(static_cast<int>(triangle));
    mix.changes.push_back(sums[triangle]);
  }
  return solver_->Apply(mix);
}

}  // namespace daumier::faces
