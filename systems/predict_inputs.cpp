#include "systems/predict_inputs.h"

#include "core/error.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <exception>
#include <set>

namespace daumier::systems {
namespace {

namespace fs = std::filesystem;

std::string LowerCase(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  return text;
}

std::vector<fs::path> InputsIn(const System& system, const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const fs::path& file = entry.path();
    const bool is_input = std::ranges::count(system.input_extensions, LowerCase(file.extension().string())) > 0;
    if (is_input && !file.filename().string().starts_with('.') && !entry.is_directory()) files.push_back(file);
  }
  std::ranges::sort(files);
  DAUMIER_CHECK(!files.empty(), "{} holds no input (expected files {}). Name another folder, or the files",
                folder.string(), fmt::join(system.input_extensions, ", "));
  return files;
}

}  // namespace

std::vector<fs::path> ExpandInputFolders(const System& system, const std::vector<fs::path>& files) {
  std::vector<fs::path> all;
  for (const fs::path& file : files) {
    if (!fs::is_directory(file)) {
      all.push_back(file);
      continue;
    }
    const std::vector<fs::path> inside = InputsIn(system, file);
    all.insert(all.end(), inside.begin(), inside.end());
  }
  return all;
}

PredictionFailure FailureOf(const fs::path& file, const std::exception& error) {
  const std::string cause = error.what();
  const bool is_named = cause.find(file.string()) != std::string::npos;
  return {file, is_named ? cause : fmt::format("{}: {}", file.string(), cause)};
}

PredictionInputs ReadPredictionInputs(const System& system, const std::vector<fs::path>& files, const Task& task) {
  PredictionInputs read;
  std::set<std::string> taken;  // In lower case: some file systems do not distinguish it.
  for (const fs::path& file : files) {
    task.ThrowIfCancelled("stopped while the inputs were read; nothing was written");
    try {
      for (Input& input : system.read_inputs(file)) {
        const std::string stem = file.stem().string();
        std::string name = stem;
        for (int copy = 2; !taken.insert(LowerCase(name)).second; ++copy) name = fmt::format("{}-{}", stem, copy);
        read.inputs.push_back({name, file, std::move(input)});
      }
    } catch (const std::exception& error) {
      read.failures.push_back(FailureOf(file, error));
    }
  }
  return read;
}

}  // namespace daumier::systems
