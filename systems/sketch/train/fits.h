#pragma once
#include "eval/face_rows.h"
#include "fitting/contour_refinement.h"
#include "fitting/morphable_fit.h"
#include "systems/sketch/drawing_fitter.h"
#include "systems/sketch/train/reader.h"

#include <memory>
#include <span>

namespace daumier::sketch {

/// Morphable-model fitting to the labelled strokes of sketches, row MMfitting of [Han et al. 2017, Table 2]: the camera
/// is known, and visible points are subsampled by 4, each with weight 4.
class MorphableRow {
 public:
  /// All arguments have to outlive it.
  MorphableRow(const SketchRunData& data, const SketchReader& reader);

  /// num_faces x 3V, cm.
  eval::FaceRows Predict(std::span<const int> faces, const fitting::MorphableFitOptions& options) const;
  /// The fit with a prior whose deviation_px, of 0.25, 0.5, 1, ... 32, has the least error over `region` on some
  /// validation faces, at most `most_faces` evenly chosen ones.
  fitting::MorphableFitOptions ChooseOptions(std::span<const int> validation, std::span<const int> region,
                                             size_t most_faces = 100) const;

 private:
  const SketchRunData& data_;
  const SketchReader& reader_;
  fitting::ProjectedModel model_;
};

/// Contour matching after the network (fitting/contour_refinement.h), on the strokes as they are drawn, without labels.
class RefinedRow {
 public:
  /// All arguments have to outlive it.
  RefinedRow(const SketchRunData& data, const SketchReader& reader);

  /// The predictions of these faces, refined: num_faces x 3V, cm.
  eval::FaceRows Refine(std::span<const int> faces, const SketchPredictions& predicted) const;

 private:
  const SketchReader& reader_;
  fitting::ContourRefiner refiner_;
};

/// Faces fitted to the same strokes as a parser reads them (DrawingFitter).
class FittedRow {
 public:
  /// All arguments have to outlive it.
  FittedRow(const SketchRunData& data, const SketchReader& reader, std::shared_ptr<const DrawingParser> parser);

  /// start: num_faces x 3V, cm, as is what comes back.
  eval::FaceRows Fit(std::span<const int> faces, const eval::FaceRows& start) const;

 private:
  const SketchReader& reader_;
  DrawingFitter fitter_;
};

}  // namespace daumier::sketch
