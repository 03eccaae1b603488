#pragma once
#include "core/options.h"
#include "fitting/face_frame.h"
#include "fitting/label_curves.h"
#include "fitting/labelled_drawing.h"
#include "fitting/opening_moves.h"
#include "render/camera.h"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace daumier::fitting {

struct LabelledFitOptions {
  double point_deviation = 0.04;
  double stroke_deviation = 0.03;
  double correlation_length = 0.25;
  double degrees_of_freedom = 4;
  double scale_strength = 20;
  double asymmetry = 0.5;
  double smooth_deviation = 0.02;
  double smooth_length = 0.35;
  double turn_deviation = 3;
  double three_quarter_yaw = 35;
  double three_quarter_deviation = 10;
  int point_rounds = 10;
  int stroke_rounds = 6;
  double reach = 0.2;
  FaceFrameOptions frame;

  template <class V>
  void Visit(V&& visit) {
    visit("point_deviation", point_deviation, Range{1e-4, 1},
          "Deviation of a drawn point from the face's, as a share of the distance of the outer corners of the eyes, as "
          "are all lengths here.");
    visit("stroke_deviation", stroke_deviation, Range{1e-4, 1}, "Deviation of a drawn line from the face's.");
    visit("correlation_length", correlation_length, Range{1e-3, 10},
          "Length of a line that counts as much as one point.");
    visit("degrees_of_freedom", degrees_of_freedom, Range{1, 1000},
          "Of the Student distribution of deviations: the fewer, the less an outlier counts.");
    visit("scale_strength", scale_strength, Range{0, 1e6},
          "How many coordinates the deviations above are worth against what the drawing itself shows of its errors.");
    visit("asymmetry", asymmetry, Range{1e-3, 1},
          "Deviation of what the sides differ by, as a share of that of faces.");
    visit("smooth_deviation", smooth_deviation, Range{1e-6, 1},
          "Of the smooth displacement that is added to the face.");
    visit("smooth_length", smooth_length, Range{0.05, 10}, "Over which it is smooth.");
    visit("turn_deviation", turn_deviation, Range{0.01, 90}, "Of yaw and pitch of a frontal face, degrees.");
    visit("three_quarter_yaw", three_quarter_yaw, Range{0, 90}, "Mean yaw of a three-quarter view, degrees.");
    visit("three_quarter_deviation", three_quarter_deviation, Range{0.01, 90}, "Its deviation, degrees.");
    visit("point_rounds", point_rounds, Range{1, 1000}, "Rounds in which points alone count.");
    visit("stroke_rounds", stroke_rounds, Range{0, 1000}, "Rounds in which lines count too.");
    visit("reach", reach, Range{0.01, 10}, "From how far lines of the face are drawn to lines of the drawing.");
    visit("frame", frame, Table{}, "How the drawing is placed at first.");
  }
};

/// What a fit to labelled drawings sees of a linear model of faces: n vertices, numbered from 0.
struct SeenFace {
  faces::FacePointVertices points;
  std::vector<LabelCurve> curves;
  std::vector<OpeningPairs> openings;
  Eigen::VectorXd mean;                             ///< 3n, cm.
  Eigen::MatrixXd modes;                            ///< M x 3n, cm: face = mean + modes^T z.
  render::Camera camera;                            ///< Orthographic.
  Eigen::Vector3d pivot = Eigen::Vector3d::Zero();  ///< Of the head's turn.

  int num_modes() const { return int(modes.rows()); }
  int num_vertices() const { return int(mean.size() / 3); }
};

/// Independent normal distributions of the weights of modes.
struct ModePrior {
  Eigen::VectorXd mean, deviation;  ///< M
};

struct SolvedFace {
  Eigen::VectorXd weights;  ///< z, M
  render::Placement frame;
  double yaw = 0, pitch = 0;  ///< Radians; as LabelledFit.
  double residual_scale = 1, rms = 0;
  int num_matched = 0;
};

/// What a drawing says of an opening: closed, open by some millimetres at least, or neither.
GapGoal GoalOf(Opening opening, const LabelledDrawing& drawing);

/// The turn of a head: yaw, then pitch, radians.
Eigen::Matrix3d TurnOf(double yaw, double pitch);

/// The maximum that LabelledFitter describes, of what it sees. Absent if the drawing shows no point.
/// @throws Error if a size of the prior differs, or a position is not finite.
std::optional<SolvedFace> SolveFace(const SeenFace& seen, const LabelledDrawing& drawing, const ModePrior& prior,
                                    const LabelledFitOptions& options = {});

}  // namespace daumier::fitting
