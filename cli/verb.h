#pragma once
#include "core/json.h"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace daumier::cli {

/// One row of the command line: a verb adds its arguments to `command` and returns the function to call once they are
/// parsed.
struct Verb {
  std::string name;
  std::string summary;
  std::function<std::function<void()>(CLI::App& command)> set_up;
  bool keeps_freed_memory = true;  ///< KeepFreedMemory: for work that repeats, not for a single file or a server.
};

Verb DatasetVerb();
Verb RegisterVerb();
Verb ImportVerb();
Verb TrainVerb();
Verb AblateVerb();
Verb EvalVerb();
Verb PredictVerb();
Verb EditVerb();
Verb ScoreVerb();
Verb BenchmarkVerb();
Verb DrawVerb();
Verb RigVerb();
Verb AvatarVerb();
Verb ExportVerb();
Verb StudioVerb();
Verb InfoVerb();

/// What follows a verb: at most one TOML file and any number of key=value.
struct ConfigArguments {
  std::filesystem::path file;
  std::vector<std::string> overrides;

  /// The resolved config. @throws UsageError as LoadConfig.
  Json Load() const;
  /// The file, or "the command line": the place that messages name.
  std::string Where() const;
};

/// Adds `--config FILE` and the trailing `key=value ...` to a command.
void AddConfigArguments(CLI::App& command, ConfigArguments& arguments);

/// One result: pretty text for people, or one JSON object with --json.
void PrintResult(const Json& result, bool as_json);

}  // namespace daumier::cli
