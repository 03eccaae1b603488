#pragma once
#include "systems/system.h"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

/// Where shipped weights lie, and which of them a prediction uses that names no run.
namespace daumier::systems {

/// Folders of which the first that holds weights is used: $DAUMIER_WEIGHTS alone if it is set; else `weights` in the
/// folder of the program and in each folder above it (the repository, or where it is installed), and in each
/// `share/daumier/weights`.
std::vector<std::filesystem::path> WeightsPlaces();

/// A folder of weights with its task.
struct ShippedWeights {
  std::filesystem::path directory;
  std::string system;

  std::string name() const { return directory.filename().string(); }
};

/// The weights in the first of `places` that holds any, by name; folders that hold no weights are ignored.
/// @throws Error naming the folder if its manifest is malformed, or if it has a network.safetensors and no manifest.
std::vector<ShippedWeights> ListWeights(std::span<const std::filesystem::path> places);

/// The weights that `name` names: a folder, or one of `shipped`. @throws UsageError listing what is there.
std::filesystem::path WeightsNamed(const std::string& name, std::span<const ShippedWeights> shipped,
                                   std::span<const std::filesystem::path> places);

/// Of the weights whose task reads every one of `inputs` (files by their extension, folders by a file in them), those of
/// the task with the largest System::shipped_rank.
/// @throws UsageError naming an input that none reads, and listing what is there.
std::filesystem::path WeightsFor(std::span<const std::filesystem::path> inputs, std::span<const System> systems,
                                 std::span<const ShippedWeights> shipped,
                                 std::span<const std::filesystem::path> places);

}  // namespace daumier::systems
