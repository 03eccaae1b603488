#pragma once
#include "core/folder_cache.h"
#include "datasets/read/sketch_database.h"
#include "systems/system.h"

namespace daumier::sketch {

/// {faces, sketches}: which data these folders are. @throws Error if the sketches are of other faces.
Json DataHashes(const std::string& faces, const std::string& sketches_folder, const datasets::SketchDatabase& sketches);

/// `daumier train` of a sketch network: opens the databases, splits, fits the bilinear models of faces and of curves
/// (and the basis of a network with a residual) on training faces, trains, and leaves a run folder that
/// LoadSketchRun reads. The manifest holds the split, the data of the fitted models, the camera of the
/// sketches, the hashes of the data and their licences, and holds no path. device: "cpu" or "cuda".
/// @throws UsageError as ParseOptions and train::OpenRunFolder, Error as Train and the databases.
TrainingSummary TrainSketch(const Json& config, const systems::RunPlace& place, FolderCache& databases,
                            const Task& task);

}  // namespace daumier::sketch
