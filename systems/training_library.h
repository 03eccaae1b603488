#pragma once
#include "core/output_place.h"
#include "runtime/network_runner.h"
#include "systems/system.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

/// libdaumier_training.so: all that needs LibTorch. The program loads it for train, eval, ablate and export, and, until
/// runtime/ runs exported graphs itself, for the networks of predictors.
namespace daumier::systems {

struct AblationRequest {
  std::filesystem::path config, out;
  std::vector<std::string> overrides, only;
  Device device;
  bool dry_run = false;
};

/// Shipped weights to be made of a finished run.
struct WeightsOrder {
  std::filesystem::path run, out;
  std::filesystem::path recipe;  ///< JSON list of {command, seconds} of which the run is the result; may be empty.
  std::filesystem::path notes;   ///< Markdown for the card; may be empty.
};

/// The folder of an ablation. Those of earlier versions have no manifest, but a table.
inline OutputKind AblationOutput() {
  return {"ablation", {"table.json", "table.md"}};
}

struct TrainingLibrary {
  std::string version;  ///< Of the build; that of the program.
  std::vector<SystemTraining> systems;
  /// Threads of LibTorch; 0: all cores.
  void (*set_up)(int threads);
  /// {libtorch, device, threads, sgemm_gflops}
  Json (*describe)();
  /// The network of a finished run of any system, or of shipped weights. @throws Error as
  /// SystemTraining::describe_export and ReadWeights.
  std::unique_ptr<runtime::NetworkRunner> (*open_network)(const std::filesystem::path& run_or_weights,
                                                          const Device& device);
  /// Writes an export of a finished run of any system and returns parity.json.
  Json (*export_run)(const std::filesystem::path& run, const std::filesystem::path& out, const Task& task);
  /// Writes shipped weights of a finished run (exporting::WriteWeights) and returns `details` of their manifest.
  Json (*write_weights)(const WeightsOrder& order, const Task& task);
  /// The config of the first row, as its file and the overrides give it: it names the system of all rows.
  Json (*ablation_config)(const AblationRequest& request);
  /// The plan of a dry run: [{row, split, seed, state}]; else the table.
  Json (*ablate)(const AblationRequest& request, const System& system, const Task& task);

  /// @throws Error naming the task and those that the library trains.
  const SystemTraining& at(std::string_view name) const;
};

/// Loads the library once, from the program's folder or its ../lib, and sets its threads (NumThreads). @throws Error
/// naming file, cause and repair if it is missing, does not load or is of another build.
const TrainingLibrary& LoadTrainingLibrary();

/// The symbol of the library: const TrainingLibrary* daumier_training_library().
inline constexpr const char* kTrainingLibrarySymbol = "daumier_training_library";
inline constexpr const char* kTrainingLibraryFile = "libdaumier_training.so";

}  // namespace daumier::systems
