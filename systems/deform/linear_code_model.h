#pragma once
#include "faces/face_gaussian.h"
#include "faces/face_model.h"
#include "fitting/code_model.h"

#include <vector>

namespace daumier::deform {

/// Vertices linear in the code: mean + sum_k c_k row_k, a row one standard deviation.
struct LinearFaces {
  faces::FaceTemplate face_template;
  geometry::Points mean;                                                       ///< V x 3, cm.
  Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows;  ///< M x 3V, cm.
  double usual_radius = 0;
  std::vector<int> expression = {};  ///< Numbers of the code that are an expression.
};

class LinearCodeModel : public fitting::CodeModel {
 public:
  /// @throws Error if shapes disagree or a number is not finite.
  explicit LinearCodeModel(LinearFaces faces);

  const faces::FaceTemplate& face_template() const override { return face_template_; }
  int num_numbers() const override { return int(shapes_.cols()); }
  bool is_linear() const override { return true; }
  double usual_radius() const override { return usual_radius_; }
  geometry::Points Vertices(const Eigen::VectorXd& code) const override;
  Eigen::VectorXd Positions(const Eigen::VectorXd& code, std::span<const int> vertices) const override;
  Eigen::MatrixXd Derivative(const Eigen::VectorXd& code, std::span<const int> vertices) const override;
  Eigen::VectorXd Latent(const Eigen::VectorXd& code) const override { return code; }

 private:
  faces::FaceTemplate face_template_;
  geometry::Points mean_;
  double usual_radius_;
  /// 3V x M, cm, all that moves a coordinate together.
  Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> shapes_;
};

/// Principal components of faces and of their mirror images. radius: usual_radius.
LinearFaces LinearFacesOf(const faces::FaceTemplate& face_template, const faces::FaceGaussian& gaussian, double radius);

/// The linear caricature model that needs no training: identity shapes of a face model, its expression shapes (a
/// deviation of 0.3), anatomical controls (a value of their artists' boldness is a deviation) and smooth warps (a
/// deviation of 0.5), to first order about the mean face. Controls of both sides of a pair are two numbers, their
/// mean and half their difference, of which the difference varies a third as much.
LinearFaces LinearCaricatures(const faces::FaceModel& model);

}  // namespace daumier::deform
