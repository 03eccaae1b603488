#pragma once
#include "core/manifest.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

/// Shipped weights: a folder weights/NAME of a few megabytes with all that a prediction needs (docs/weights.md). Its
/// manifest.json has the kind "weights" and in `details`
///   weights_version  kWeightsVersion
///   system           the task of its network, or "face model"
///   needs            {NAME: data hash} of the weights next to it without which it cannot be used
namespace daumier {

inline constexpr const char* kWeightsKind = "weights";
inline constexpr int kWeightsVersion = 1;

/// Data, licences, commands, errors and limits, for people.
inline constexpr const char* kWeightsCard = "README.md";
/// Parameters and buffers of a network.
inline constexpr const char* kWeightsNetwork = "network.safetensors";
/// The network's graph as ONNX, whose tensors lie in kWeightsNetwork where that has them: what predictions run.
inline constexpr const char* kWeightsGraph = "network.onnx";

/// `details.system` of weights that are a face model and no network.
inline constexpr const char* kFaceModelSystem = "face model";

/// What a system adds to the weights of its network.
struct WeightsParts {
  std::map<std::string, std::string> checksums = {};  ///< Of further files, by name.
  Json details = Json::object();                      ///< Of the manifest: `needs` and what its predictor reads.
};

/// Whether the folder has a manifest.json of weights.
bool IsWeightsFolder(const std::filesystem::path& directory);

/// @throws Error if the folder holds numbers (.safetensors), but its manifest.json is missing or names no kind; or if it
/// holds those of a network and is of another kind.
void CheckNotDamaged(const std::filesystem::path& directory);

/// The manifest of shipped weights, of which no file is read. @throws Error as ReadWeights, but for what it says of files.
Manifest ReadWeightsManifest(const std::filesystem::path& directory, const std::string& system = "");

/// The manifest of shipped weights, with every file compared with its checksum.
/// @throws Error naming file, cause and repair if there are none, if they are of another version or (unless `system` is
/// empty) of another task, if the card or one of `files` is not listed, or if a file is missing or has changed.
Manifest ReadWeights(const std::filesystem::path& directory, const std::string& system = "",
                     const std::vector<std::string>& files = {});

/// The name of weights: that of their folder.
std::string WeightsName(const std::filesystem::path& directory);

/// The folder `name` next to that of weights, whether it is there or not.
std::filesystem::path WeightsNextTo(const std::filesystem::path& directory, const std::string& name);

/// WeightsNextTo of weights that those in `directory` need.
/// @throws Error naming the folder and the repair if it is missing or has another data hash.
std::filesystem::path NeededWeights(const std::filesystem::path& directory, const Manifest& manifest,
                                    const std::string& name);

}  // namespace daumier
