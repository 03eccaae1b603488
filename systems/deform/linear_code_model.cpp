#include "systems/deform/linear_code_model.h"

#include "core/error.h"
#include "core/parallel.h"
#include "faces/controls/artist_habits.h"
#include "faces/controls/face_controls.h"
#include "faces/controls/smooth_warps.h"
#include "fitting/code_prior.h"

#include <algorithm>
#include <utility>

namespace daumier::deform {
namespace {

/// Vertices that a core computes at once.
constexpr Eigen::Index kBlock = 512;
constexpr double kExpressionDeviation = 0.3, kWarpDeviation = 0.5, kAsymmetry = 1.0 / 3;

void CheckSize(const Eigen::VectorXd& code, Eigen::Index expected) {
  DAUMIER_CHECK(code.size() == expected, "a code of {} numbers, expected {}", code.size(), expected);
}

}  // namespace

LinearCodeModel::LinearCodeModel(LinearFaces faces)
    : face_template_(std::move(faces.face_template)),
      mean_(std::move(faces.mean)),
      usual_radius_(faces.usual_radius),
      shapes_(faces.rows.cols(), faces.rows.rows()) {
  const Eigen::Index num_vertices = face_template_.num_vertices();
  DAUMIER_CHECK(mean_.rows() == num_vertices && faces.rows.cols() == 3 * num_vertices && faces.rows.rows() > 0,
                "a linear model of {} vertices and {} x {} rows, expected {} vertices", mean_.rows(), faces.rows.rows(),
                faces.rows.cols(), num_vertices);
  DAUMIER_CHECK(mean_.allFinite() && faces.rows.allFinite(), "a linear model has a number that is not finite");
  OnAllCores(num_vertices, [&](int64_t v) {  // A few columns at a time stay in the cache.
    shapes_.middleRows<3>(3 * v) = faces.rows.middleCols<3>(3 * v).transpose();
  });
}

geometry::Points LinearCodeModel::Vertices(const Eigen::VectorXd& code) const {
  CheckSize(code, shapes_.cols());
  const Eigen::VectorXf numbers = code.cast<float>();
  geometry::Points vertices = mean_;
  const Eigen::Index count = (vertices.rows() + kBlock - 1) / kBlock;
  OnAllCores(count, [&](int64_t block) {
    const Eigen::Index begin = block * kBlock, size = std::min(kBlock, vertices.rows() - begin);
    const Eigen::VectorXf moves = shapes_.middleRows(3 * begin, 3 * size) * numbers;
    vertices.middleRows(begin, size) +=
        Eigen::Map<const Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>>(moves.data(), size, 3)
            .cast<double>();
  });
  return vertices;
}

Eigen::VectorXd LinearCodeModel::Positions(const Eigen::VectorXd& code, std::span<const int> vertices) const {
  CheckSize(code, shapes_.cols());
  const Eigen::VectorXf numbers = code.cast<float>();
  Eigen::VectorXd positions(3 * std::ssize(vertices));
  for (size_t p = 0; p < vertices.size(); ++p)
    positions.segment<3>(3 * Eigen::Index(p)) =
        mean_.row(vertices[p]).transpose() + (shapes_.middleRows<3>(3 * vertices[p]) * numbers).cast<double>();
  return positions;
}

Eigen::MatrixXd LinearCodeModel::Derivative(const Eigen::VectorXd& code, std::span<const int> vertices) const {
  CheckSize(code, shapes_.cols());
  Eigen::MatrixXd derivative(3 * std::ssize(vertices), shapes_.cols());
  for (size_t p = 0; p < vertices.size(); ++p)
    derivative.middleRows<3>(3 * Eigen::Index(p)) = shapes_.middleRows<3>(3 * vertices[p]).cast<double>();
  return derivative;
}

LinearFaces LinearFacesOf(const faces::FaceTemplate& face_template, const faces::FaceGaussian& gaussian,
                          double radius) {
  const Eigen::VectorXd mean = gaussian.mean.cast<double>();
  return {face_template, Eigen::Map<const geometry::Points>(mean.data(), mean.size() / 3, 3), gaussian.rows, radius};
}

LinearFaces LinearCaricatures(const faces::FaceModel& model) {
  const faces::FaceTemplate& face_template = model.face_template;
  const faces::FaceControls controls(face_template, faces::SmoothWarps(face_template));
  const Eigen::MatrixXf& jacobian = controls.Jacobian();
  const Eigen::Index num_identity = model.identity_shapes.cols(), num_expression = model.expression_shapes.cols();
  LinearFaces result;
  result.face_template = face_template;
  result.mean = face_template.neutral;
  result.rows.resize(num_identity + num_expression + controls.num_values(), 3 * face_template.num_vertices());
  result.rows.topRows(num_identity) = model.identity_shapes.transpose();
  result.rows.middleRows(num_identity, num_expression) =
      float(kExpressionDeviation) * model.expression_shapes.transpose();
  for (Eigen::Index e = 0; e < num_expression; ++e) result.expression.push_back(int(num_identity + e));
  Eigen::Index row = num_identity + num_expression;
  for (const faces::FaceControls::Entry& entry : controls.entries()) {
    const auto deviation = float(faces::HabitOf(entry.control.name).boldness);
    const auto first = jacobian.col(entry.first_value);
    if (entry.num_values() == 1) {
      const bool is_sideways = entry.control.sides == faces::FaceControl::Sides::kSideways;
      result.rows.row(row++) = deviation * (is_sideways ? float(kAsymmetry) : 1.0f) * first.transpose();
    } else {
      const auto second = jacobian.col(entry.first_value + 1);
      result.rows.row(row++) = deviation * (first + second).transpose();
      result.rows.row(row++) = deviation * float(kAsymmetry) * (first - second).transpose();
    }
  }
  for (size_t g = 0; g < controls.given().size(); ++g) {
    const bool is_sideways = controls.given()[g].sides == faces::FaceControl::Sides::kSideways;
    result.rows.row(row++) = float(kWarpDeviation * (is_sideways ? kAsymmetry : 1.0)) *
                             jacobian.col(controls.first_given_value() + Eigen::Index(g)).transpose();
  }
  DAUMIER_CHECK(row == result.rows.rows(), "{} rows of a linear model, expected {}", row, result.rows.rows());
  result.usual_radius = fitting::NormalRadius(int(result.rows.rows()));
  return result;
}

}  // namespace daumier::deform
