#pragma once
#include "core/options.h"
#include "faces/face_points.h"
#include "fitting/labelled_drawing.h"
#include "render/framing.h"

#include <Eigen/Core>

#include <optional>

namespace daumier::fitting {

struct FaceFrameOptions {
  double scale_deviation = 0.4;
  double turn_deviation = 12;
  double point_deviation = 0.06;
  int rounds = 20;

  template <class V>
  void Visit(V&& visit) {
    visit("scale_deviation", scale_deviation, Range{1e-3, 100},
          "Deviation of the scale from that of sketches, as a share of it.");
    visit("turn_deviation", turn_deviation, Range{0.1, 90}, "Deviation of the turn from 0, degrees.");
    visit(
        "point_deviation", point_deviation, Range{1e-3, 1},
        "Least deviation of points of a drawing from those of a face, as a share of the distance of the outer corners "
        "of the eyes.");
    visit("rounds", rounds, Range{1, 1000}, "How often points are weighted again.");
  }
};

/// Where the sheet of a camera lies on the canvas of a drawing (render::ToCanvas: from this sheet to that canvas): the
/// similarity that lays the projected points of a face on the points of the drawing [Umeyama 1991, in the plane], in the
/// sense of least weighted squares: the weight of a point is its confidence times (1 + r^2 / s^2)^-2 of Geman and
/// McClure, r its distance and s three times the greater of point_deviation and 1.48 times the median distance. Scale
/// and turn have normal priors about 1 and 0, which matter where few points are shown. Points of a contour match its
/// nearest place, found again in each round. projected: V x 2, of a face on its sheet.
/// Absent if no point is shown. Promises: exact where the points are those of the face moved by a similarity, up to
/// the priors; a similarity of the drawing moves the frame by it, up to the priors.
/// @throws Error if the outer corners of the eyes coincide or a position is not finite.
std::optional<render::Placement> FindFaceFrame(const faces::FacePointVertices& vertices,
                                               const Eigen::MatrixX2d& projected, const LabelledDrawing& drawing,
                                               const FaceFrameOptions& options = {});

/// Distance of the outer corners of the eyes of a projected face.
double EyeDistance(const faces::FacePointVertices& vertices, const Eigen::MatrixX2d& projected);

}  // namespace daumier::fitting
