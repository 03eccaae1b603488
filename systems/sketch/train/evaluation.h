#pragma once
#include "core/json.h"
#include "systems/sketch/evaluation_options.h"

#include <filesystem>
#include <string>

namespace daumier::sketch {

/// `daumier eval` of a sketch run: errors of the network on one side of its split beside the free baselines
/// (eval/, fitted on training faces) and the limit of the bilinear model, which is its best reconstruction
/// of each true face, in the least-squares sense over the region `face` that the errors are averaged over. Ridge
/// regression stands there once more on the shape-level numbers alone, given and recovered (eval/shape_input.h;
/// "predicted" are those of the network's own face, without a snap). A network that reads these numbers stands there
/// with given and, if recover_with is told, with recovered ones, which then are the run's result. With `strength` > 0
/// sketches are augmented, each once; baselines then read the curve points that the shape-level numbers rebuild, since
/// strokes are missing. `fit` adds rows of morphable-model fitting (eval/sketch_fits.h), `refine` one of the result
/// after contour matching, `deform` that row and one of its faces moved onto the strokes
/// (fitting/stroke_deformation.h). Writes into `out_directory` metrics.json (returned), table.md, a report with
/// pictures (eval/report.h) and a manifest. metrics.json: num_faces, num_persons, split, shape_input,
/// mean_vertex_error_mm, p90_vertex_error_mm, mean_face_baseline_mm, nearest_neighbour_mm, ridge_mm, model_limit_mm;
/// also interval_mm, interocular_share, augmentation_strength, shape_error_px (given, predicted, recovered),
/// ridge_lambda, regions_mm (mean of the network over the annotation's eyes, mouth and nose, and elsewhere in the
/// face), table (TableJson of all rows, with the errors of each face), data_hash, seconds, and of each face in order
/// faces, groups (whom it shows, as far as the split tells persons apart) and face_errors_mm (the network's). @throws
/// Error as OpenSketchRunData, or if recover_with is a run on other data or reads shape-level numbers itself;
/// UsageError if the side is empty.
Json EvaluateSketchRun(const std::filesystem::path& run_directory, const std::filesystem::path& out_directory,
                       const SketchEvalOptions& options = {});

}  // namespace daumier::sketch
