#pragma once
#include "faces/face_gaussian.h"
#include "faces/face_model.h"
#include "fitting/labelled_solver.h"
#include "fitting/opening_moves.h"
#include "render/camera.h"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace daumier::fitting {

/// What is known of a face before its drawing is read.
struct FacePrior {
  Eigen::VectorXf mean;  ///< Coefficients of the FaceGaussian; empty: zeros.
  double share = 1;      ///< Deviation of the coefficients from the mean, as a share of that of faces.
};

struct LabelledFit {
  /// 3V, cm, turned by yaw and pitch as the drawing shows the face: the sheet's camera sees it where the frame says.
  std::vector<float> vertices;
  Eigen::VectorXf coefficients;  ///< Of the FaceGaussian; smooth displacement and closing come on top.
  render::Placement frame;
  /// As TurnedCamera: the face looks to the left of the picture by yaw > 0, downwards by pitch > 0.
  double yaw_degrees = 0, pitch_degrees = 0;
  Eigen::Vector3d pivot = Eigen::Vector3d::Zero();  ///< Of the turn.
  double residual_scale = 1;  ///< Deviation of the drawing from the face, in units of the options' deviations.
  double smooth_share = 1;    ///< Share of the smooth displacement that folds nothing.
  double rms = 0;             ///< Root mean square distance of the shown points, as a share of the eye distance.
  int num_matched = 0;        ///< Points of strokes that lines of the face are drawn to.
  int num_flipped = 0;        ///< Triangles of the region `face` whose normal turns by more than 90 degrees against the
                              ///< face of the Gaussian alone.
  int num_crossed_lips = 0, num_crossed_lids = 0;  ///< Pairs of places that cross by more than 0.1 mm.
};

/// An upright face (3V, cm) turned as that of the fit.
std::vector<float> TurnedAs(const LabelledFit& fit, const Eigen::VectorXf& face);
/// The face back in the pose of its template.
std::vector<float> Upright(const LabelledFit& fit);

/// Fits a face to a parsed drawing: the maximum of
///   log N(c; prior) + log N(w; 0, I) + log p(frame, yaw, pitch) + sum_i log t((p_i - P_i) / (k s_i))
/// over coefficients c of a Gaussian of faces, weights w of smooth displacements in the plane (SmoothModes), a similarity
/// of the canvas (FindFaceFrame), and yaw and pitch of the head. p_i are the shown points and samples of strokes with a label,
/// P_i their counterparts under an orthographic camera: landmarks, nearest places of contours and of curves of the same
/// label, of which the normal distance counts. t is Student's distribution, solved by reweighted Gauss-Newton steps, and
/// its scale k comes from the drawing [MacKay 1992, eq. 2.8, with an inverse gamma prior at 1]: the farther a drawing is from
/// any face, the nearer the result stays to the prior. What the drawing does not show stays at the prior, given the rest.
/// Lips and lids do not cross. A mouth that is closed closes, an open one opens as far as drawn; so do eyes
/// (OpeningMover).
class LabelledFitter {
 public:
  /// @throws Error if the camera is in perspective, the Gaussian has other vertices, or a landmark is missing.
  LabelledFitter(const faces::FaceTemplate& face_template, const render::Camera& camera, faces::FaceGaussian gaussian,
                 const LabelledFitOptions& options = {});

  /// Absent if the drawing shows no point. Thread-safe. @throws Error if a prior has another size, or a position is
  /// not finite.
  std::optional<LabelledFit> Fit(const LabelledDrawing& drawing, const FacePrior& prior = {}) const;

  const faces::FaceGaussian& gaussian() const { return gaussian_; }
  int num_modes() const { return seen_.num_modes(); }

 private:
  faces::FaceTemplate template_;
  faces::FaceGaussian gaussian_;
  LabelledFitOptions options_;
  OpeningMover mover_;
  faces::BilinearModel::Core smooth_rows_;  ///< M - K x 2V
  SeenFace seen_;
  Eigen::VectorXd rescale_;  ///< K: coefficient of the Gaussian = rescale * weight of the fit.
};

}  // namespace daumier::fitting
