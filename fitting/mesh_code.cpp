#include "fitting/mesh_code.h"

#include "core/error.h"
#include "core/evenly_spaced.h"
#include "core/stopwatch.h"

#include <cmath>
#include <numeric>
#include <utility>

namespace daumier::fitting {

MeshCoder::MeshCoder(const CodeModel& model, const MeshCodeOptions& options) : model_(model), options_(options) {
  DAUMIER_CHECK(options.num_points > 0 && options.ridge > 0 && options.steps > 0,
                "the fit of a code reads {} points with a ridge of {} in {} steps, expected positive numbers",
                options.num_points, options.ridge, options.steps);
  std::vector<int> all(static_cast<size_t>(model.face_template().num_vertices()));
  std::iota(all.begin(), all.end(), 0);
  points_ = EvenlySpaced(all, options.num_points);
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(model.num_numbers());
  mean_ = Scale() * model.Positions(zero, points_);
  derivative_ = Scale() * model.Derivative(zero, points_);
  if (!model.is_linear()) return;
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(derivative_.cols(), derivative_.cols());
  normal.selfadjointView<Eigen::Lower>().rankUpdate(derivative_.transpose());
  normal.diagonal().array() += options.ridge;
  factor_.compute(normal);
}

double MeshCoder::Scale() const {
  return 1 / std::sqrt(double(points_.size()));
}

Minimum MeshCoder::Code(const geometry::Points& target) const {
  const int num_vertices = model_.face_template().num_vertices();
  DAUMIER_CHECK(target.rows() == num_vertices, "a mesh of {} vertices, expected {}", target.rows(), num_vertices);
  DAUMIER_CHECK(target.allFinite(), "the mesh has a vertex that is no finite number");
  Eigen::VectorXd wanted(3 * std::ssize(points_));
  for (size_t p = 0; p < points_.size(); ++p)
    wanted.segment<3>(3 * Eigen::Index(p)) = Scale() * target.row(points_[p]).transpose();
  const Eigen::VectorXd missing = wanted - mean_;
  if (model_.is_linear()) {
    const Eigen::VectorXd code = factor_.solve(derivative_.transpose() * missing);
    return {
        code,
        {missing.squaredNorm(), (missing - derivative_ * code).squaredNorm() + options_.ridge * code.squaredNorm()}};
  }
  const SquaredEnergy energy{.residuals = [&](const Eigen::VectorXd& code) -> Eigen::VectorXd {
                               if (code.isZero(0)) return -missing;
                               return Scale() * model_.Positions(code, points_) - wanted;
                             },
                             .derivative = [&](const Eigen::VectorXd& code) -> Eigen::MatrixXd {
                               if (code.isZero(0)) return derivative_;
                               return Scale() * model_.Derivative(code, points_);
                             },
                             .prior_weights = Eigen::VectorXd::Constant(model_.num_numbers(), options_.ridge),
                             .prior_mean = Eigen::VectorXd::Zero(model_.num_numbers())};
  return Minimise(energy, Eigen::VectorXd::Zero(model_.num_numbers()), options_.steps);
}

MeshCode CodeOfMesh(const CodeModel& model, const geometry::Points& target, const MeshCodeOptions& options) {
  const Stopwatch watch;
  Minimum minimum = MeshCoder(model, options).Code(target);
  MeshCode result{std::move(minimum.x), {}, 0, std::move(minimum.energies), 0};
  result.vertices = model.Vertices(result.code);
  result.mean_error_cm = (result.vertices - target).rowwise().norm().mean();
  result.seconds = watch.seconds();
  return result;
}

Eigen::MatrixXd CodesOfMeshes(const CodeModel& model, int count, const std::function<geometry::Points(int)>& mesh,
                              const MeshCodeOptions& options, const Task& task) {
  const MeshCoder coder(model, options);
  Eigen::MatrixXd codes(count, model.num_numbers());
  for (int i = 0; i < count; ++i) {
    task.ThrowIfCancelled("the codes of meshes were stopped after {} of {}", i, count);
    codes.row(i) = coder.Code(mesh(i)).x.transpose();
    task.Report(i + 1, count, "faces");
  }
  return codes;
}

}  // namespace daumier::fitting
