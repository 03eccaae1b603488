#pragma once
#include "core/folder_cache.h"
#include "core/task.h"
#include "reports/evaluation.h"
#include "systems/sketch/evaluation_options.h"

#include <filesystem>

namespace daumier::sketch {

/// Evaluation of a run on an external face database, options.faces and options.sketches: all faces, predicted as by
/// `daumier predict`, but in the frame of their sketches. Rows: the mean face of the bilinear model (of its mean u and
/// v), the network (the result), the network with its contours matched, that and the mean face fitted to the sketches
/// as a parser reads them (DrawingFitter), the upper bound of the model, and of faces of the run's own topology with exact
/// sketches ridge regression and nearest neighbour (eval/baselines.h), which read labelled curve points and are fitted
/// on the run's training data; they are left out if that cannot be opened. Columns: error and p90, mean vertex error in
/// mm over the region `face` with the scale of the faces' own template, absent for another topology; matched_error, of
/// registered faces (`daumier register`) that over the vertices with a match on the registered mesh, since elsewhere
/// the registration made up the "true" face; curve_error_px, the two-way distance in pixels of the 256 canvas between
/// the drawn silhouette and feature lines, as augmented, and the face's projected curves; of a fitted face in its frame.
/// metrics: num_faces, data_hash, run_data_hash, same_topology, augmentation_strength, table. The sheet has a row for
/// each face of reports::ChooseFaces by the network's error in mm, or pixels for another topology.
/// @throws Error as LoadSketchRun, OpenParserOfRun and the databases, or if the sketches are of other faces; Cancelled.
reports::Evaluation EvaluateOnExternalFaces(const std::filesystem::path& run_directory,
                                            const SketchEvalOptions& options, FolderCache& databases,
                                            const Task& task = {});

}  // namespace daumier::sketch
