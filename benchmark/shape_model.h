#pragma once
#include "eval/face_rows.h"
#include "fitting/code_landmarks.h"

#include <vector>

namespace daumier::benchmark {

/// A statistical shape model: mean + sum_k c_k deviation_k component_k, by principal components of faces and of their mirror images.
class ShapeModel : public fitting::CodeModel {
 public:
  /// faces: n x 3V, cm. At most `num_components`, and two fewer than there are faces and mirror images.
  /// @throws Error if there are fewer than two faces, or as eval::FitPrincipalComponents.
  ShapeModel(const faces::FaceTemplate& face_template, const eval::FaceRows& faces, int num_components);

  const faces::FaceTemplate& face_template() const override { return face_template_; }
  int num_numbers() const override { return int(shapes_.cols()); }
  bool is_linear() const override { return true; }
  double usual_radius() const override { return usual_radius_; }
  geometry::Points Vertices(const Eigen::VectorXd& code) const override;
  Eigen::VectorXd Positions(const Eigen::VectorXd& code, std::span<const int> vertices) const override;
  Eigen::MatrixXd Derivative(const Eigen::VectorXd& code, std::span<const int> vertices) const override;
  Eigen::VectorXd Latent(const Eigen::VectorXd& code) const override { return code; }

 private:
  const faces::FaceTemplate& face_template_;
  Eigen::VectorXd mean_;                                                           ///< 3V
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> shapes_;  ///< 3V x M
  double usual_radius_ = 0;
};

/// The code and the similarity of least  sum_i |S D(c)_i - q_i|^2 / deviation^2 + |c|^2,  in ten rounds of S and c. vertices: of the
/// points; places: P x 3, cm. Moving, turning and scaling the places changes nothing but S. @throws Error unless there is a place for
/// each vertex and the deviation (cm of the model) is above 0.
Eigen::VectorXd FitShapeToPlaces(const ShapeModel& model, const std::vector<int>& vertices,
                                 const geometry::Points& places, double deviation_cm);

}  // namespace daumier::benchmark
