#include "systems/predict_inputs.h"

#include "core/error.h"
#include "core/files.h"

#include "core/log.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <exception>
#include <map>
#include <new>
#include <set>

namespace daumier::systems {
namespace {

namespace fs = std::filesystem;

std::string LowerCase(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  return text;
}

/// `stem`, or the first of stem-2, stem-3, ... that no result has.
std::string FreeName(const std::string& stem, std::set<std::string>& taken) {
  std::string name = stem;
  for (int copy = 2; !taken.insert(LowerCase(name)).second; ++copy) name = fmt::format("{}-{}", stem, copy);
  return name;
}

std::vector<fs::path> InputsIn(const System& system, const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const fs::path& file = entry.path();
    if (IsInputFile(system, file) && !file.filename().string().starts_with('.') && !entry.is_directory())
      files.push_back(file);
  }
  std::ranges::sort(files);
  DAUMIER_CHECK(!files.empty(), "{} holds no input (expected files {}). Name another folder, or the files",
                folder.string(), fmt::join(system.input_extensions, ", "));
  return files;
}

}  // namespace

bool IsInputFile(const System& system, const fs::path& file) {
  return std::ranges::count(system.input_extensions, LowerCase(file.extension().string())) > 0;
}

std::vector<fs::path> ExpandInputFolders(const System& system, const std::vector<fs::path>& files) {
  std::vector<fs::path> all;
  for (const fs::path& file : files) {
    if (!fs::is_directory(file)) {
      all.push_back(file);
      continue;
    }
    const std::vector<fs::path> inside = InputsIn(system, file);
    all.insert(all.end(), inside.begin(), inside.end());
    if (const std::string skipped = SkippedFilesText(system, file); !skipped.empty())
      log::Info("{}: {}; name a file to have it read", file.string(), skipped);
  }
  return all;
}

std::string SkippedFilesText(const System& system, const fs::path& folder) {
  std::map<std::string, int> kinds;
  int num_skipped = 0;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const fs::path name = entry.path().filename();
    if (entry.is_directory() || IsInputFile(system, name) || IsSystemFile(name) || name == "manifest.json") continue;
    ++kinds[name.has_extension() ? LowerCase(name.extension().string()) : "without an extension"];
    ++num_skipped;
  }
  if (num_skipped == 0) return "";
  std::vector<std::string> counts;
  for (const auto& [kind, count] : kinds) counts.push_back(fmt::format("{} {}", kind, count));
  constexpr size_t kMaxKinds = 8;
  if (counts.size() > kMaxKinds) counts.resize(kMaxKinds), counts.emplace_back("...");
  return fmt::format("{} file{} skipped ({})", num_skipped, num_skipped == 1 ? "" : "s", fmt::join(counts, ", "));
}

PredictionFailure FailureOf(const fs::path& file, const std::exception& error) {
  const bool lacks_memory = dynamic_cast<const std::bad_alloc*>(&error) != nullptr;
  const std::string cause =
      lacks_memory ? "there is not enough memory for it. Free some, or make it smaller" : error.what();
  const bool is_named = cause.find(file.string()) != std::string::npos;
  return {file, is_named ? cause : fmt::format("{}: {}", file.string(), cause)};
}

PredictionInputs ReadPredictionInputs(const System& system, const std::vector<fs::path>& files, const Task& task) {
  PredictionInputs read;
  std::set<std::string> taken;  // In lower case: some file systems do not distinguish it.
  for (const fs::path& file : files) {
    task.ThrowIfCancelled("stopped while the inputs were read; nothing was written");
    try {
      std::error_code ignored;  // A pipe would never end.
      DAUMIER_CHECK(!fs::exists(file, ignored) || fs::is_regular_file(file, ignored),
                    "{}: no regular file (a pipe, a socket or a device). Copy it to a file", file.string());
      for (Input& input : system.read_inputs(file)) {
        read.inputs.push_back({FreeName(file.stem().string(), taken), file, std::move(input)});
      }
    } catch (const std::exception& error) {
      read.failures.push_back(FailureOf(file, error));
    }
  }
  return read;
}

PredictionInputs SeparateInputs(const Predictor& predictor, PredictionInputs inputs) {
  std::set<std::string> taken;
  for (const PredictionInput& input : inputs.inputs) taken.insert(LowerCase(input.name));
  PredictionInputs apart{{}, std::move(inputs.failures)};
  for (PredictionInput& input : inputs.inputs) {
    try {
      std::vector<Input> faces = predictor.Separate(std::move(input.input));
      for (size_t i = 0; i < faces.size(); ++i) {
        const std::string name =
            faces.size() == 1 ? input.name : FreeName(fmt::format("{}_{}", input.name, i + 1), taken);
        apart.inputs.push_back({name, input.file, std::move(faces[i])});
      }
    } catch (const std::exception& error) {
      apart.failures.push_back(FailureOf(input.file, error));
    }
  }
  return apart;
}

}  // namespace daumier::systems
