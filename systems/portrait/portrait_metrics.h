#pragma once
#include "reports/metric_table.h"

#include <vector>

namespace daumier::portrait {

/// Names of rows of an evaluation.
inline constexpr const char* kPortraitNetworkRow = "network";
inline constexpr const char* kRefinedRow = "network, refined";
inline constexpr const char* kMeanFaceRow = "mean face, pose fitted";
inline constexpr const char* kLandmarkFitRow = "landmark fit";

/// Columns of the table of a report: error (mm after a similarity, ShapeMeasure), landmark_error (% of the distance of the
/// eyes' outer corners), angle_error (degrees), photometric (sum over RGB of |difference|, colours 0 .. 1, mean over the
/// pixels that show the face in both pictures), closed_eyes, wink and mouth (mm, errors of gaps), ms (a picture).
const std::vector<reports::Metric>& PortraitColumns();
/// Columns of a table of several runs, besides the error.
std::vector<reports::Metric> PortraitSummaryColumns();

}  // namespace daumier::portrait
