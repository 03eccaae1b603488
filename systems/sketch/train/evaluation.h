#pragma once
#include "core/folder_cache.h"
#include "core/task.h"
#include "reports/evaluation.h"
#include "systems/sketch/evaluation_options.h"

#include <filesystem>

namespace daumier::sketch {

/// `daumier eval` of a sketch run: vertex errors of the network on one subset of its split, mm over the region `face`.
/// A network that reads curve coefficients has a row with given ones and, with recover_with, one with recovered ones,
/// which is the result then. Further rows: the training-free baselines and ridge regression on curve coefficients
/// (baseline_rows.h); `fit`: morphable-model fitting (fits.h); `refine`: the result after contour matching; `deform`:
/// the network's faces fitted to the sketches as a parser reads them (DrawingFitter). With `strength` > 0 each sketch is
/// augmented once; with `styled` it is drawn in a style of people. `strokes`:
/// errors by the number of strokes (ReportPrefixes), a table, a chart and the key `strokes`. With `faces` the run is measured on other faces: EvaluateOnExternalFaces.
/// metrics: num_faces, num_persons, split, shape_input, mean_vertex_error_mm, p90_vertex_error_mm,
/// mean_face_baseline_mm, nearest_neighbour_mm, ridge_mm, model_limit_mm; also interval_mm, interocular_share,
/// augmentation_strength, styled, shape_error_px (given, predicted, recovered), ridge_lambda, regions_mm (of the result: eyes,
/// mouth, nose, elsewhere), table (reports::TableJson), data_hash, seconds; of each face in order faces, groups (the
/// person it shows, as far as the split separates persons) and face_errors_mm (of the result).
/// @throws Error as OpenSketchRunData, if recover_with is a run on other data or reads curve coefficients itself, or if
/// an error is not finite; UsageError if the side is empty or options exclude each other; Cancelled.
reports::Evaluation EvaluateSketchRun(const std::filesystem::path& run_directory, const SketchEvalOptions& options,
                                      FolderCache& databases, const Task& task = {});

}  // namespace daumier::sketch
