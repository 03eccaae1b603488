#include "benchmark/shape_model.h"

#include "core/error.h"
#include "eval/principal_components.h"
#include "geometry/alignment.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace daumier::benchmark {
namespace {

constexpr uint64_t kComponentsSeed = 1;
constexpr int kFitRounds = 10;

/// The faces, then their mirror images.
eval::FaceRows WithMirrorImages(const eval::FaceRows& faces, const std::vector<int>& mirror) {
  if (mirror.empty()) return faces;
  eval::FaceRows both(2 * faces.rows(), faces.cols());
  both.topRows(faces.rows()) = faces;
  for (Eigen::Index row = 0; row < faces.rows(); ++row) {
    for (Eigen::Index v = 0; v < std::ssize(mirror); ++v) {
      const auto other = faces.row(row).segment<3>(3 * mirror[size_t(v)]);
      both.row(faces.rows() + row).segment<3>(3 * v) << -other[0], other[1], other[2];
    }
  }
  return both;
}

}  // namespace

ShapeModel::ShapeModel(const faces::FaceTemplate& face_template, const eval::FaceRows& faces, int num_components)
    : face_template_(face_template) {
  DAUMIER_CHECK(faces.rows() >= 2 && faces.cols() == 3 * face_template.num_vertices(),
                "{} faces of {} coordinates, expected two or more of {}", faces.rows(), faces.cols(),
                3 * face_template.num_vertices());
  const eval::CentredRows rows = eval::Centre(WithMirrorImages(faces, face_template.annotation.mirror));
  const int size = int(std::min<Eigen::Index>(num_components, rows.rows.rows() - 1));
  const eval::PrincipalComponents components = eval::FitPrincipalComponents(rows, size, kComponentsSeed);
  mean_ = rows.mean.transpose().cast<double>();
  shapes_ = (components.deviations.cast<double>().asDiagonal() * components.rows.cast<double>()).transpose();
  usual_radius_ = std::sqrt(2.0 * size);
}

geometry::Points ShapeModel::Vertices(const Eigen::VectorXd& code) const {
  DAUMIER_CHECK(code.size() == num_numbers(), "a code of {} numbers, expected {}", code.size(), num_numbers());
  const Eigen::VectorXd numbers = mean_ + shapes_ * code;
  return Eigen::Map<const geometry::Points>(numbers.data(), numbers.size() / 3, 3);
}

Eigen::VectorXd ShapeModel::Positions(const Eigen::VectorXd& code, std::span<const int> vertices) const {
  DAUMIER_CHECK(code.size() == num_numbers(), "a code of {} numbers, expected {}", code.size(), num_numbers());
  Eigen::VectorXd positions(3 * std::ssize(vertices));
  for (Eigen::Index i = 0; i < std::ssize(vertices); ++i)
    positions.segment<3>(3 * i) =
        mean_.segment<3>(3 * vertices[size_t(i)]) + shapes_.middleRows<3>(3 * vertices[size_t(i)]) * code;
  return positions;
}

Eigen::MatrixXd ShapeModel::Derivative(const Eigen::VectorXd& code, std::span<const int> vertices) const {
  DAUMIER_CHECK(code.size() == num_numbers(), "a code of {} numbers, expected {}", code.size(), num_numbers());
  Eigen::MatrixXd derivative(3 * std::ssize(vertices), num_numbers());
  for (Eigen::Index i = 0; i < std::ssize(vertices); ++i)
    derivative.middleRows<3>(3 * i) = shapes_.middleRows<3>(3 * vertices[size_t(i)]);
  return derivative;
}

Eigen::VectorXd FitShapeToPlaces(const ShapeModel& model, const std::vector<int>& vertices,
                                 const geometry::Points& places, double deviation_cm) {
  DAUMIER_CHECK(places.rows() == std::ssize(vertices), "{} places of {} vertices", places.rows(), vertices.size());
  DAUMIER_CHECK(deviation_cm > 0, "the deviation is {}, expected > 0", deviation_cm);
  const int size = model.num_numbers();
  Eigen::VectorXd code = Eigen::VectorXd::Zero(size);
  const Eigen::VectorXd mean = model.Positions(code, vertices);
  const Eigen::MatrixXd rows = model.Derivative(code, vertices) / deviation_cm;
  const Eigen::LLT<Eigen::MatrixXd> normal(rows.transpose() * rows + Eigen::MatrixXd::Identity(size, size));
  for (int round = 0; round < kFitRounds; ++round) {
    const Eigen::VectorXd positions = model.Positions(code, vertices);
    const geometry::Points own = Eigen::Map<const geometry::Points>(positions.data(), places.rows(), 3);
    const geometry::Points seen = geometry::AlignSimilarity(places, own).Apply(places);
    const Eigen::VectorXd offset = (Eigen::Map<const Eigen::VectorXd>(seen.data(), seen.size()) - mean) / deviation_cm;
    code = normal.solve(rows.transpose() * offset);
  }
  return code;
}

}  // namespace daumier::benchmark
