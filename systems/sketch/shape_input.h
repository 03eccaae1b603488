#pragma once
#include "datasets/read/sketch_database.h"
#include "faces/bilinear_model.h"
#include "faces/curve_encoder.h"
#include "faces/face_model.h"
#include "fitting/curve_recovery.h"
#include "fitting/projected_curves.h"

#include <span>
#include <vector>

namespace daumier::sketch {

/// The curve coefficients of sketches: from strokes labelled with the template's curves, which a network
/// can be given in training and in a test alone, and from strokes without labels, as a user draws them.
class ShapeInput {
 public:
  /// `curves` is a model of datasets::FitCurvesOnTraining on these sketches. All arguments have to outlive it.
  ShapeInput(const faces::BilinearModel& curves, const datasets::SketchDatabase& sketches,
             const faces::FaceTemplate& face_template, const faces::CurveEncoderOptions& options = {});

  /// From labelled strokes: all points that came in, where the sketch has them, and whether it shows them
  /// (datasets::AugmentedSketch::moved and visible; an empty `visible`: all).
  faces::CurveCode Given(const std::vector<render::Stroke>& strokes,
                         const std::vector<std::vector<bool>>& visible = {}) const;
  /// From drawn strokes without labels and a face that was predicted, 3V in cm: its curves, seen by the sketches'
  /// camera, snap to the strokes `snaps` times; 0: they are used unchanged.
  faces::CurveCode Recovered(std::span<const float> predicted_face, const std::vector<render::Stroke>& drawn,
                             const fitting::CurveRecoveryOptions& options = {}) const;
  /// Mean distance in pixels of the canvas between the points of a code and those of labelled strokes.
  double ErrorPx(const faces::CurveCode& code, const std::vector<render::Stroke>& truth) const;

 private:
  const datasets::SketchDatabase& sketches_;
  faces::CurveEncoder encoder_;
  fitting::ProjectedCurves projected_;
};

}  // namespace daumier::sketch
