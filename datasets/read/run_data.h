#pragma once
#include "core/json.h"
#include "core/manifest.h"
#include "datasets/read/splits.h"
#include "faces/face_database.h"

#include <filesystem>
#include <string>
#include <vector>

/// The data of a run folder of any product, as it was trained on them.
namespace daumier::datasets {

/// The folder of the data of a `kind` ("faces") that a run was trained on: `moved`, unless that is empty; else the
/// folder that config.data.`kind` names; else, where that is absent, the folder of a path that ends as that one does,
/// from a folder above the run: the place of data that moved together with the run.
/// manifest_kind: of the folder's manifest, if other than `kind`.
/// @throws Error if there is none, or if its data hash is not the one that the run was trained on.
std::filesystem::path FindRunData(const std::filesystem::path& run, const Manifest& manifest, const Json& config,
                                  const std::string& kind, const std::string& moved = "",
                                  const std::string& manifest_kind = "");

/// The split of the run's faces. @throws Error if it differs from that in the manifest.
Split SplitOfRun(const std::filesystem::path& run, const Manifest& manifest, const Json& config,
                 const faces::FaceDatabase& faces);

/// The manifest with which a training begins: its config without paths, seed, the sources of its faces, how many of
/// them are in which subset of the split (`training_faces`, `validation_faces`, `test_faces`), and who they are.
Manifest ManifestOfTraining(Json config, uint64_t seed, const faces::FaceDatabase& faces, const Split& split);

/// "train", "validation" or "test". @throws UsageError for another word.
const std::vector<int>& SubsetOf(const Split& split, const std::string& name);

}  // namespace daumier::datasets
