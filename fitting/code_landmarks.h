#pragma once
#include "fitting/code_model.h"
#include "fitting/contour_paths.h"

#include <Eigen/Core>

#include <vector>

namespace daumier::fitting {

/// A point of a picture and the vertex that it shows.
struct PicturedPoint {
  int vertex = -1;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();  ///< x to the right, y down.
  int jaw_landmark = -1;  ///< 0 .. 16: the vertex slides along this path of ContourPaths; -1: it is fixed.
};

/// The 68 landmarks of a template as points; those that are not finite are left out. landmarks: 68 x 2.
/// @throws Error if there are not 68.
std::vector<PicturedPoint> PicturedLandmarks(const faces::FaceTemplate& face_template, const PicturePoints& landmarks);

/// A scaled orthographic view: pixel = scale (R p).xy (1, -1) + shift.
struct ScaledView {
  double scale = 1;  ///< Pixels a cm.
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();

  /// points: N x 3, cm.
  PicturePoints Project(const geometry::Points& points) const;
};

/// The view of least weighted squares of points seen in a picture [Kemelmacher-Shlizerman and Seitz 2011, section 3]:
/// an affine map, brought to a rotation and a scale. @throws Error if sizes differ, there are fewer than four points
/// of weight above 0, or they lie in one place.
ScaledView FindScaledView(const geometry::Points& points, const PicturePoints& pixels, const Eigen::VectorXd& weights);

struct CodeLandmarkOptions {
  double deviation = 0.015;  ///< Of points from the model, as a share of the distance of the outer corners of the eyes.
  int rounds = 12;           ///< Of view, silhouette, weights and code, at most.
  bool adjusts_code = true;  ///< Otherwise the mean face in its best pose.
};

struct CodeLandmarkFit {
  Eigen::VectorXd code;  ///< M
  ScaledView view;
  std::vector<int> vertices;     ///< Of each point, on the silhouette where it slides.
  PicturePoints pixels;          ///< Of these, in the picture.
  Eigen::VectorXd distances_px;  ///< From the given points.
  Eigen::VectorXd weights;       ///< Of the last round, 0 .. 1: a point that fits badly has a small one.
  double eye_distance_px = 0;    ///< Of the template's outer eye corners in this view's scale.
  bool is_usual = true;          ///< |code| is within the model's usual radius.
  int rounds = 0;
};

/// 2-D landmarks -> 3-D [Jung et al. 2022, eq. 3]: the code and the view of least
///   E(c, view) = sum_i w_i |view(D(c)_i) - q_i|^2 / s^2 + |c|^2,
/// s = deviation times the distance of the outer eye corners in pixels, w_i = (1 + r_i^2 / t^2)^-2 of Geman and
/// McClure, r_i the distance of the point and t three times the greater of s and 1.48 times the median of r. In
/// rounds: the view alone, the silhouette (ContourPaths), the weights, then code and view together (Minimise), until
/// E falls by less than 1e-3 of itself. Only the points are decoded. Promises: points of the model's own face in a
/// view give them back, up to the prior; scaling, shifting and rotating the picture gives the same code.
/// @throws Error if there are fewer than six points, a vertex is out of range, a pixel is not finite, or as
/// FindScaledView.
CodeLandmarkFit FitCodeToLandmarks(const CodeModel& model, const ContourPaths& contour,
                                   const std::vector<PicturedPoint>& points, const CodeLandmarkOptions& options = {});

/// Where a picture shows the 68 landmarks of a face of the model: those of the jaw on the silhouette. 68 x 2.
PicturePoints ShownLandmarks(const CodeModel& model, const ContourPaths& contour, const Eigen::VectorXd& code,
                             const ScaledView& view);

}  // namespace daumier::fitting
