#pragma once
#include "core/json.h"

#include <filesystem>
#include <string>

namespace daumier::eval {

/// `daumier eval` of a sketch run: errors of the network on one side of its split ("train", "validation", "test")
/// beside the free baselines (eval/baselines.h, fitted on training faces) and the limit of the bilinear model, which is
/// its best reconstruction of each true face, in the least-squares sense over the region `face` that the errors are
/// averaged over. Ridge regression stands there once more on the shape-level numbers alone, given and recovered
/// (eval/shape_input.h; "predicted" are those of the network's own face, without a snap). With `strength` > 0 test
/// sketches are augmented, each once; baselines then read the curve points that the shape-level numbers rebuild, since
/// strokes are missing. Writes into `out_directory` metrics.json (returned), table.md, a report with pictures
/// (eval/report.h) and a manifest. metrics.json: num_faces, num_persons, split, shape_input, mean_vertex_error_mm,
/// p90_vertex_error_mm, mean_face_baseline_mm, nearest_neighbour_mm, ridge_mm, model_limit_mm; also interval_mm,
/// interocular_share, augmentation_strength, shape_error_px (given, predicted, recovered), ridge_lambda, table
/// (TableJson of all rows), data_hash, seconds. @throws Error as OpenSketchRunData; UsageError if the side is unknown
/// or empty.
Json EvaluateSketchRun(const std::filesystem::path& run_directory, const std::string& split_side,
                       const std::filesystem::path& out_directory, double strength = 0);

}  // namespace daumier::eval
