#pragma once
#include "core/task.h"
#include "systems/system.h"

#include <exception>
#include <filesystem>
#include <string>
#include <vector>

/// The inputs of a prediction of many files, of which a bad one spoils only itself.
namespace daumier::systems {

struct PredictionInput {
  std::string name;  ///< Of its results.
  std::filesystem::path file;
  Input input;
};

/// An input without a result.
struct PredictionFailure {
  std::filesystem::path file;
  std::string cause;  ///< Names the file.
};

/// The failure of a file by what was thrown.
PredictionFailure FailureOf(const std::filesystem::path& file, const std::exception& error);

struct PredictionInputs {
  std::vector<PredictionInput> inputs;
  std::vector<PredictionFailure> failures;
};

/// Whether System::input_extensions lists the extension of a file, which need not exist.
bool IsInputFile(const System& system, const std::filesystem::path& file);

/// `files`, where a folder is replaced by the files in it, not in its subfolders, whose extension System::input_extensions
/// lists, by name. Hidden files and the `._` files of macOS are skipped, and others with a line in the log.
/// @throws Error naming a folder without such a file.
std::vector<std::filesystem::path> ExpandInputFolders(const System& system,
                                                      const std::vector<std::filesystem::path>& files);

/// The files of a folder that ExpandInputFolders skips, by kind: "3 files skipped (.pdf 2, .txt 1)"; empty if none.
/// Hidden files, manifest.json and folders do not count.
std::string SkippedFilesText(const System& system, const std::filesystem::path& folder);

/// Reads every file. NAME is the file's; inputs of the same name are numbered -2, -3, ... A file that cannot be read is
/// a failure. @throws Cancelled if the task is.
PredictionInputs ReadPredictionInputs(const System& system, const std::vector<std::filesystem::path>& files,
                                      const Task& task = {});

/// The inputs that the predictor separates (Predictor::Separate) in place of the one that they come from: NAME_1,
/// NAME_2, ... One that it refuses is a failure.
PredictionInputs SeparateInputs(const Predictor& predictor, PredictionInputs inputs);

}  // namespace daumier::systems
