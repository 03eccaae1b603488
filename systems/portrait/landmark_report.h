#pragma once
#include "core/json.h"
#include "reports/report_table.h"
#include "systems/portrait/landmark_measurement.h"

#include <map>
#include <span>
#include <vector>

/// What a report says of measurements of a detector.
namespace daumier::portrait {

/// {num, found, median, mean, p90 and eyes_median of the errors of those found, box_given: the same of all pictures with the
/// true box, rival: {num_found, ...} or null, milliseconds (median), pictures: [{name, found, confidence, error, eyes}]}.
Json PicturesToJson(std::span<const PictureMeasurement> pictures);
/// {num, false_faces at least_confidence, by_threshold: {"0.10": n, ...}, pictures: [{name, confidence}] of those of 0.1 and more}.
Json NegativesToJson(std::span<const NegativeMeasurement> negatives, double least_confidence);
/// Errors of the given pictures as a table: all, the detector with box searched and given, and the rival.
reports::ReportTable PicturesTable(const Json& pictures);

/// Mean error of each skin tone, and spread = (largest - smallest) / mean of the tones' errors.
Json TonesToJson(const std::map<int, std::vector<double>>& errors_of_tones);
/// Intersection over union of each class by name, and `mean`.
Json LabelsToJson(const LabelCounts& counts);
/// Shares of wrong states by name.
Json StatesToJson(std::span<const PortraitMeasurement> portraits);

}  // namespace daumier::portrait
