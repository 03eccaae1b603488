#pragma once
#include "core/folder_cache.h"
#include "datasets/read/sketch_variation.h"
#include "datasets/read/splits.h"
#include "faces/face_database.h"
#include "systems/sketch/evaluation_options.h"
#include "systems/sketch/train/run.h"

#include <filesystem>
#include <string>
#include <vector>

namespace daumier::sketch {

/// A trained run together with the data that it was trained on, split as it was then.
struct SketchRunData {
  SketchRun run;
  faces::FaceDatabase faces;
  datasets::SketchDatabase sketches;
  datasets::Split split;
  datasets::SketchVariation sketch;  ///< Of the training sketches.

  /// "train", "validation" or "test". @throws UsageError for another word.
  const std::vector<int>& side(const std::string& name) const;
};

/// Opens the databases of datasets::FindRunData by `databases`. @throws Error as LoadSketchRun, FindRunData and the
/// databases, and if the split differs from that of the manifest.
SketchRunData OpenSketchRunData(const std::filesystem::path& run_directory, FolderCache& databases,
                                const SketchEvalData& moved = {});
/// The same with a cache of its own.
SketchRunData OpenSketchRunData(const std::filesystem::path& run_directory);

}  // namespace daumier::sketch
