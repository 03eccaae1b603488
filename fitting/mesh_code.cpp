#include "fitting/mesh_code.h"

#include "core/error.h"
#include "core/evenly_spaced.h"
#include "core/stopwatch.h"
#include "fitting/gauss_newton.h"

#include <Eigen/Cholesky>

#include <cmath>
#include <numeric>

namespace daumier::fitting {

namespace {

void CheckMesh(const CodeModel& model, const geometry::Points& target, const MeshCodeOptions& options) {
  const int num_vertices = model.face_template().num_vertices();
  DAUMIER_CHECK(target.rows() == num_vertices, "a mesh of {} vertices, expected {}", target.rows(), num_vertices);
  DAUMIER_CHECK(target.allFinite(), "the mesh has a vertex that is no finite number");
  DAUMIER_CHECK(options.num_points > 0 && options.ridge > 0 && options.steps > 0,
                "the fit of a code reads {} points with a ridge of {} in {} steps, expected positive numbers",
                options.num_points, options.ridge, options.steps);
}

/// The vertices that a fit reads.
std::vector<int> PointsOfFit(const CodeModel& model, const MeshCodeOptions& options) {
  std::vector<int> all(static_cast<size_t>(model.face_template().num_vertices()));
  std::iota(all.begin(), all.end(), 0);
  return EvenlySpaced(all, options.num_points);
}

/// x0 y0 z0 x1 ... of some vertices.
Eigen::VectorXd NumbersOf(const geometry::Points& mesh, const std::vector<int>& points) {
  Eigen::VectorXd numbers(3 * std::ssize(points));
  for (size_t p = 0; p < points.size(); ++p) numbers.segment<3>(3 * Eigen::Index(p)) = mesh.row(points[p]).transpose();
  return numbers;
}

}  // namespace

MeshCode CodeOfMesh(const CodeModel& model, const geometry::Points& target, const MeshCodeOptions& options) {
  const Stopwatch watch;
  CheckMesh(model, target, options);
  const int num_numbers = model.num_numbers();
  const std::vector<int> points = PointsOfFit(model, options);
  const Eigen::VectorXd wanted = NumbersOf(target, points);
  const double scale = 1 / std::sqrt(double(points.size()));
  const SquaredEnergy energy{.residuals = [&](const Eigen::VectorXd& code) -> Eigen::VectorXd {
                               return scale * (model.Positions(code, points) - wanted);
                             },
                             .derivative = [&](const Eigen::VectorXd& code) -> Eigen::MatrixXd {
                               return scale * model.Derivative(code, points);
                             },
                             .prior_weights = Eigen::VectorXd::Constant(num_numbers, options.ridge),
                             .prior_mean = Eigen::VectorXd::Zero(num_numbers),
                             .is_linear = model.is_linear()};
  Minimum minimum = Minimise(energy, Eigen::VectorXd::Zero(num_numbers), options.steps);
  MeshCode result{std::move(minimum.x), {}, 0, std::move(minimum.energies), 0};
  result.vertices = model.Vertices(result.code);
  result.mean_error_cm = (result.vertices - target).rowwise().norm().mean();
  result.seconds = watch.seconds();
  return result;
}

Eigen::MatrixXd CodesOfMeshes(const CodeModel& model, int count, const std::function<geometry::Points(int)>& mesh,
                              const MeshCodeOptions& options, const Task& task) {
  const int num_numbers = model.num_numbers();
  Eigen::MatrixXd codes(count, num_numbers);
  const std::vector<int> points = PointsOfFit(model, options);
  Eigen::VectorXd mean;
  Eigen::MatrixXd derivative;
  Eigen::LLT<Eigen::MatrixXd> factor;
  if (model.is_linear()) {
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(num_numbers);
    mean = model.Positions(zero, points);
    derivative = model.Derivative(zero, points);
    Eigen::MatrixXd normal = derivative.transpose() * derivative;
    normal.diagonal().array() += options.ridge * double(points.size());
    factor.compute(normal);
  }
  for (int i = 0; i < count; ++i) {
    task.ThrowIfCancelled("the codes of meshes were stopped after {} of {}", i, count);
    const geometry::Points target = mesh(i);
    CheckMesh(model, target, options);
    if (model.is_linear()) {
      const Eigen::VectorXd moments = derivative.transpose() * (NumbersOf(target, points) - mean);
      codes.row(i) = factor.solve(moments).transpose();
    } else {
      codes.row(i) = CodeOfMesh(model, target, options).code.transpose();
    }
    task.Report(i + 1, count, "faces");
  }
  return codes;
}

}  // namespace daumier::fitting
