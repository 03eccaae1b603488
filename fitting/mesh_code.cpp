#include "fitting/mesh_code.h"

#include "core/error.h"
#include "core/evenly_spaced.h"
#include "core/stopwatch.h"
#include "fitting/gauss_newton.h"

#include <cmath>
#include <numeric>

namespace daumier::fitting {

MeshCode CodeOfMesh(const CodeModel& model, const geometry::Points& target, const MeshCodeOptions& options) {
  const Stopwatch watch;
  const int num_vertices = model.face_template().num_vertices(), num_numbers = model.num_numbers();
  DAUMIER_CHECK(target.rows() == num_vertices, "a mesh of {} vertices, expected {}", target.rows(), num_vertices);
  DAUMIER_CHECK(target.allFinite(), "the mesh has a vertex that is no finite number");
  DAUMIER_CHECK(options.num_points > 0 && options.ridge > 0 && options.steps > 0,
                "the fit of a code reads {} points with a ridge of {} in {} steps, expected positive numbers",
                options.num_points, options.ridge, options.steps);
  std::vector<int> all(static_cast<size_t>(num_vertices));
  std::iota(all.begin(), all.end(), 0);
  const std::vector<int> points = EvenlySpaced(all, options.num_points);
  const Eigen::Index num_rows = 3 * Eigen::Index(points.size());
  Eigen::VectorXd wanted(num_rows);
  for (size_t p = 0; p < points.size(); ++p) wanted.segment<3>(3 * Eigen::Index(p)) = target.row(points[p]).transpose();
  const double scale = 1 / std::sqrt(double(points.size())), prior = std::sqrt(options.ridge);

  const Residuals residuals{.at =
                                [&](const Eigen::VectorXd& code) {
                                  Eigen::VectorXd r(num_rows + num_numbers);
                                  r << scale * (model.Positions(code, points) - wanted), prior * code;
                                  return r;
                                },
                            .derivative =
                                [&](const Eigen::VectorXd& code) {
                                  Eigen::MatrixXd j = Eigen::MatrixXd::Zero(num_rows + num_numbers, num_numbers);
                                  j.topRows(num_rows) = scale * model.Derivative(code, points);
                                  j.bottomRows(num_numbers).diagonal().setConstant(prior);
                                  return j;
                                },
                            .is_linear = model.is_linear()};
  Minimum minimum = Minimise(residuals, Eigen::VectorXd::Zero(num_numbers), options.steps);
  MeshCode result{std::move(minimum.x), {}, 0, std::move(minimum.energies), 0};
  result.vertices = model.Vertices(result.code);
  result.mean_error_cm = (result.vertices - target).rowwise().norm().mean();
  result.seconds = watch.seconds();
  return result;
}

}  // namespace daumier::fitting
