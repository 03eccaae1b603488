#pragma once
#include "fitting/code_model.h"

#include <vector>

namespace daumier::fitting {

/// A point on a surface: sum_k weights[k] * corner k of a triangle of the template.
struct TrianglePoint {
  int triangle = 0;
  Eigen::Vector3d weights = Eigen::Vector3d::Constant(1.0 / 3);  ///< None negative, sum 1.
};

/// A model with points on its surface in addition to its V vertices: point V + k of Positions and Derivative is
/// sum_j w_j D(c)_j over the corners j of its triangle, w its weights. All else is the model's.
class SurfacePointModel : public CodeModel {
 public:
  /// The model has to outlive it. @throws Error if a triangle does not exist, or weights are negative or do not sum to 1.
  SurfacePointModel(const CodeModel& model, const std::vector<TrianglePoint>& points);

  const faces::FaceTemplate& face_template() const override { return model_.face_template(); }
  int num_numbers() const override { return model_.num_numbers(); }
  int num_points() const override { return model_.num_points() + int(points_.size()); }
  bool is_linear() const override { return model_.is_linear(); }
  double usual_radius() const override { return model_.usual_radius(); }
  geometry::Points Vertices(const Eigen::VectorXd& code) const override { return model_.Vertices(code); }
  Eigen::VectorXd Positions(const Eigen::VectorXd& code, std::span<const int> points) const override;
  Eigen::MatrixXd Derivative(const Eigen::VectorXd& code, std::span<const int> points) const override;
  Eigen::VectorXd Latent(const Eigen::VectorXd& code) const override { return model_.Latent(code); }

 private:
  struct Corners {
    Eigen::Vector3i vertices;
    Eigen::Vector3d weights;
  };
  /// The model's own points that `points` need: themselves, three for each of ours.
  std::vector<int> OwnPoints(std::span<const int> points) const;
  /// Rows of `of_own` (three a point of OwnPoints) as those of `points`.
  Eigen::MatrixXd Mixed(const Eigen::MatrixXd& of_own, std::span<const int> points) const;

  const CodeModel& model_;
  std::vector<Corners> points_;
};

}  // namespace daumier::fitting
