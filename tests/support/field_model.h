#pragma once
#include "fitting/code_model.h"
#include "tests/support/synthetic_face.h"

#include <cmath>

/// Small deformable surfaces that are known exactly, on the synthetic face.
namespace daumier::testing {

/// vertices = neutral + sum_k f(c_k) row_k over six smooth fields of about a centimetre: scales along the axes, a nose
/// and two sides of a jaw. f(c) = c, or c + bend c^2 / 2.
class FieldModel : public fitting::CodeModel {
 public:
  explicit FieldModel(double bend = 0) : face_(SyntheticFace()), bend_(bend), rows_(kFields, 3 * face_.num_vertices()) {
    const geometry::Points& p = face_.neutral;
    for (Eigen::Index v = 0; v < p.rows(); ++v) {
      const double x = p(v, 0), y = p(v, 1), z = p(v, 2);
      const double nose = std::exp(-(x * x + (y + 1) * (y + 1)) / 8) * (z > 0 ? 1 : 0);
      const double jaw = std::exp(-(y + 8) * (y + 8) / 18);
      rows_.col(3 * v) << 0.1 * x, 0, 0, 0, jaw * std::exp(-(x - 5) * (x - 5) / 8),
          -jaw * std::exp(-(x + 5) * (x + 5) / 8);
      rows_.col(3 * v + 1) << 0, 0.1 * y, 0, 0, -0.3 * jaw * (x > 0), -0.3 * jaw * (x < 0);
      rows_.col(3 * v + 2) << 0, 0, 0.1 * z, 2 * nose, 0, 0;
    }
  }

  static constexpr int kFields = 6;

  const faces::FaceTemplate& face_template() const override { return face_; }
  int num_numbers() const override { return kFields; }
  bool is_linear() const override { return bend_ == 0; }
  double usual_radius() const override { return 4; }
  geometry::Points Vertices(const Eigen::VectorXd& code) const override {
    const Eigen::RowVectorXd moves = Bent(code).transpose() * rows_;
    return face_.neutral + Eigen::Map<const geometry::Points>(moves.data(), moves.size() / 3, 3);
  }
  Eigen::VectorXd Positions(const Eigen::VectorXd& code, std::span<const int> vertices) const override {
    const geometry::Points all = Vertices(code);
    Eigen::VectorXd positions(3 * std::ssize(vertices));
    for (size_t i = 0; i < vertices.size(); ++i)
      positions.segment<3>(3 * Eigen::Index(i)) = all.row(vertices[i]).transpose();
    return positions;
  }
  Eigen::MatrixXd Derivative(const Eigen::VectorXd& code, std::span<const int> vertices) const override {
    Eigen::MatrixXd derivative(3 * std::ssize(vertices), kFields);
    for (size_t i = 0; i < vertices.size(); ++i)
      derivative.middleRows<3>(3 * Eigen::Index(i)) = rows_.middleCols<3>(3 * vertices[i]).transpose();
    return derivative * (1 + bend_ * code.array()).matrix().asDiagonal();
  }
  Eigen::VectorXd Latent(const Eigen::VectorXd& code) const override { return code; }

 private:
  Eigen::VectorXd Bent(const Eigen::VectorXd& code) const { return code.array() + bend_ / 2 * code.array().square(); }

  faces::FaceTemplate face_;
  double bend_;
  Eigen::MatrixXd rows_;
};

}  // namespace daumier::testing
