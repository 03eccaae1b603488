#pragma once
#include "faces/face_model.h"
#include "geometry/mesh.h"

#include <Eigen/Core>

#include <span>

namespace daumier::fitting {

/// A deformable surface: a code -> the vertices of a template. Codes are standardised: over the faces that the model
/// was made of their numbers have mean 0 and covariance I, so that the code 0 is the mean face and |c|^2 the prior's
/// energy.
class CodeModel {
 public:
  CodeModel() = default;
  CodeModel(const CodeModel&) = delete;
  CodeModel& operator=(const CodeModel&) = delete;
  virtual ~CodeModel() = default;

  virtual const faces::FaceTemplate& face_template() const = 0;
  virtual int num_numbers() const = 0;  ///< M
  /// Points that Positions and Derivative have: the V vertices, and those that a model adds to another one.
  virtual int num_points() const { return face_template().num_vertices(); }
  /// Whether positions are linear in the code: its derivative is the same everywhere.
  virtual bool is_linear() const = 0;
  /// The 99th percentile of |c| over the faces that the model was made of: codes beyond it are unlike these.
  virtual double usual_radius() const = 0;

  /// All vertices, V x 3, cm. @throws Error unless the code has M numbers, as the two below.
  virtual geometry::Points Vertices(const Eigen::VectorXd& code) const = 0;
  /// Some vertices (points): 3P numbers x0 y0 z0 x1 ..., cm. Time grows with P, not with V.
  virtual Eigen::VectorXd Positions(const Eigen::VectorXd& code, std::span<const int> vertices) const = 0;
  /// Their derivative by the code, 3P x M.
  virtual Eigen::MatrixXd Derivative(const Eigen::VectorXd& code, std::span<const int> vertices) const = 0;
  /// The numbers of the model itself, as its run stores them.
  virtual Eigen::VectorXd Latent(const Eigen::VectorXd& code) const = 0;
};

}  // namespace daumier::fitting
