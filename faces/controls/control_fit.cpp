#include "faces/controls/control_fit.h"

#include "core/error.h"

#include <Eigen/Cholesky>

namespace daumier::faces {
namespace {

constexpr double kRidge = 0.01;

}  // namespace

ControlFit::ControlFit(const FaceControls& controls, const FaceTemplate& face_template,
                       const std::vector<geometry::Points>& population)
    : region_(RegionFor(face_template.annotation, "face", "a measure of controls")) {
  DAUMIER_CHECK(population.size() >= size_t(kFewestFaces),
                "{} neutral faces are too few to measure what distinguishes a person; at least {} are needed",
                population.size(), int(kFewestFaces));
  mean_ = geometry::Points::Zero(face_template.num_vertices(), 3);
  for (const geometry::Points& face : population) {
    DAUMIER_CHECK(face.rows() == mean_.rows(), "a face of {} vertices, the template has {}", face.rows(), mean_.rows());
    mean_ += face / double(population.size());
  }
  std::vector<int> rows;
  for (const int v : region_) rows.insert(rows.end(), {3 * v, 3 * v + 1, 3 * v + 2});
  const Eigen::MatrixXf jacobian = controls.Jacobian()(rows, Eigen::all);
  Eigen::MatrixXd normal = (jacobian.transpose() * jacobian).cast<double>();
  normal.diagonal().array() += kRidge * normal.trace() / double(normal.rows());
  solver_ = normal.llt().solve(jacobian.transpose().cast<double>()).cast<float>();

  Eigen::VectorXd squares = Eigen::VectorXd::Zero(controls.num_values());
  for (const geometry::Points& face : population) squares += ValuesOf(face).cwiseAbs2();
  for (const FaceControls::Entry& entry : controls.entries()) {
    auto own = squares.segment(entry.first_value, entry.num_values());
    own.setConstant(own.mean());
  }
  deviations_ = (squares / double(population.size())).cwiseSqrt();
}

Eigen::VectorXd ControlFit::ValuesOf(const geometry::Points& face) const {
  DAUMIER_CHECK(face.rows() == mean_.rows(), "a face of {} vertices, the template has {}", face.rows(), mean_.rows());
  const geometry::Points difference = (face - mean_)(region_, Eigen::all);
  return (solver_ * Eigen::Map<const Eigen::VectorXd>(difference.data(), difference.size()).cast<float>())
      .cast<double>();
}

}  // namespace daumier::faces
