#pragma once
#include "core/json.h"
#include "reports/report_table.h"
#include "systems/portrait/alignment_measurement.h"

#include <vector>

namespace daumier::portrait {

/// Landmarks by part: mean distance in pixels and as a share of the interocular distance, of the fit to all landmarks;
/// then held-out ones (every other one; parts left out in turn). paper: adds the printed errors of each row.
reports::ReportTable LandmarkTable(const std::vector<AlignmentRow>& rows);
/// Errors of landmarks of a part that was left out of the fit, a column a part, shares of the interocular distance.
reports::ReportTable LeftOutTable(const std::vector<AlignmentRow>& rows);
/// Shape, colours, flips, intersections, milliseconds. persons: of each portrait, resampled as one for intervals.
reports::ReportTable ShapeTable(const std::vector<AlignmentRow>& rows, const std::vector<int>& persons);
/// Numbers of the three tables, by method.
Json AlignmentJson(const std::vector<AlignmentRow>& rows);

}  // namespace daumier::portrait
