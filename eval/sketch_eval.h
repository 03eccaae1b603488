#pragma once
#include "core/json.h"

#include <filesystem>
#include <string>

namespace daumier::eval {

/// `daumier eval` of a sketch run: errors of the network on one side of its split ("train", "validation", "test")
/// beside the free baselines (eval/baselines.h, fitted on training faces) and the limit of the bilinear model, which is
/// its best reconstruction of each true face, in the least-squares sense over the region `face` that the errors are
/// averaged over. Writes into `out_directory` metrics.json (returned), table.md, a report with pictures (eval/report.h)
/// and a manifest. metrics.json: num_faces, num_persons, split, shape_input, mean_vertex_error_mm, p90_vertex_error_mm,
/// mean_face_baseline_mm, nearest_neighbour_mm, ridge_mm, model_limit_mm; also interval_mm, interocular_share,
/// ridge_lambda, table (TableJson of all rows), data_hash, seconds. @throws Error as OpenSketchRunData; UsageError if
/// the side is unknown or empty.
Json EvaluateSketchRun(const std::filesystem::path& run_directory, const std::string& split_side,
                       const std::filesystem::path& out_directory);

}  // namespace daumier::eval
