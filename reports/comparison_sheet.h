#pragma once
#include "geometry/mesh.h"
#include "render/image.h"
#include "reports/face_surface.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace daumier::reports {

/// What one predictor made of a face.
struct ComparedPrediction {
  geometry::Points face;     ///< V x 3, cm.
  Eigen::VectorXd error_mm;  ///< V; NaN where no error is counted (shown grey).
  double mean_error_mm = 0;  ///< Below the picture.
};

/// A row of the sheet: one input, and what each predictor made of it.
struct ComparedFace {
  std::string title;                            ///< Left of the row: "median".
  render::Image sketch;                         ///< Square, grey or RGB; empty where the input is no picture.
  geometry::Points truth;                       ///< V x 3, cm.
  std::vector<ComparedPrediction> predictions;  ///< One a predictor.
};

/// Predictors side by side as in figure 15 of [Han et al. 2017]: a row a face, in it the sketch, the true face, and of
/// each predictor its face coloured by the distance of each vertex from the true one, all in one frame, which
/// holds the true faces, and with one colour bar. Without any sketch there is no column for them. The colours end at
/// `range_mm`; 0: at twice the mean of mean_error_mm, rounded up.
/// @throws Error if there is no face or no predictor, a face has not one prediction for each of `names`, or shapes
/// disagree.
render::Image ComparisonSheet(const ReportSurface& surface, const std::vector<std::string>& names,
                              const std::vector<ComparedFace>& faces, double range_mm = 0);

}  // namespace daumier::reports
