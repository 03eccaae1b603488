#pragma once
#include "core/json.h"
#include "tensor/tensor_file.h"

#include <filesystem>
#include <optional>

namespace daumier::train {

/// All that a training needs to resume as if it had never stopped, on any device. On disk a folder: model.safetensors,
/// optimiser.safetensors, random.safetensors, state.json ({format_version, state, checksums}) and time.json
/// ({seconds}). Only time.json has a clock; the others have equal bytes in equal trainings. None has a path or host
/// name.
struct Checkpoint {
  tensor::NamedTensors model;
  tensor::NamedTensors optimiser;
  tensor::NamedTensors random;    ///< States of LibTorch's generators by device name.
  Json state = Json::object();    ///< The trainer's own numbers.
  std::optional<double> seconds;  ///< Of training until now, across resumes; absent in checkpoints of older versions.
};

/// Replaces the checkpoint of that folder. A kill at any point leaves either the old one or the new one whole: the new
/// one is written next to it, as DIRECTORY.new, and then takes its place, while the old one waits as DIRECTORY.old.
/// @throws Error as WriteFileAtomically.
void WriteCheckpoint(const std::filesystem::path& directory, const Checkpoint& checkpoint);

/// The newest whole checkpoint of that folder, or nothing if none was ever finished there.
/// @throws Error naming the file if it is damaged or of a newer version.
std::optional<Checkpoint> ReadCheckpoint(const std::filesystem::path& directory);

}  // namespace daumier::train
