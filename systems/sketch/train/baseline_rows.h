#pragma once
#include "systems/sketch/train/shape_codes.h"

#include <vector>

namespace daumier::sketch {

struct BaselineRows {
  std::vector<reports::MetricRow> rows;
  double ridge_lambda = 0;
  Json shape_error_px = Json::object();  ///< By input, mean over test faces.
};

/// The training-free baselines (eval/baselines.h), fitted on training faces: mean face, nearest neighbour, ridge
/// regression on curve points, and the upper bound of the bilinear model, its least-squares reconstruction of each true
/// face over the region `face`. Then ridge regression on curve coefficients: given, and if they can be recovered also
/// those of the predicted face and recovered ones. Of augmented sketches (strength > 0) baselines read the curve points
/// that the given coefficients rebuild. `codes` has to have those of training faces.
BaselineRows MeasureBaselines(const SketchTestSet& test, const ShapeCodes& codes, double strength);

}  // namespace daumier::sketch
