#include "cli/config_kind.h"
#include "cli/system_table.h"
#include "cli/verb.h"
#include "core/output_place.h"
#include "core/process_task.h"
#include "core/run_manifest.h"
#include "systems/training_library.h"

#include <fmt/core.h>

#include <memory>
#include <utility>
#include <vector>

namespace daumier::cli {
namespace {

/// The folders that a new run reads. Data may lie in the folder of a run that is resumed, which overwrites none of them.
std::vector<std::filesystem::path> DataOf(const Json& config, const systems::RunPlace& place) {
  std::vector<std::filesystem::path> folders;
  if (place.resume) return folders;
  for (const auto& [database, folder] : config.at("data").items()) folders.push_back(folder.get<std::string>());
  return folders;
}

}  // namespace

Verb TrainVerb() {
  return {"train", "Train a network from a config into a run folder", [](CLI::App& command) {
            struct Arguments {
              ConfigArguments config;
              std::filesystem::path out;
              bool resume = false;
              std::string device = "cpu";
            };
            auto arguments = std::make_shared<Arguments>();
            command.add_option("config", arguments->config.file, "TOML file of the run")->required();
            command.add_option("overrides", arguments->config.overrides,
                               "key=value or table.key=value, in TOML syntax");
            command.add_option("-o,--out", arguments->out, "Run folder")->required();
            command.add_flag("--resume", arguments->resume, "Resume from the last checkpoint of the run folder");
            command.add_option("--device", arguments->device, "cpu or cuda")->capture_default_str();
            std::string footer;
            for (const systems::System& system : Systems())
              footer += fmt::format("Options, system = \"{}\":\n{}", system.name, system.training_help());
            command.footer(footer);
            return [arguments] {
              const auto [system, resolved] = ReadConfigOf("train", arguments->config.file, [&] {
                const Json config = arguments->config.Load();
                const systems::System& found = SystemOfConfig(config);
                return std::pair(&found, found.resolve_config(config, arguments->config.Where()));
              });
              const systems::RunPlace place{arguments->out, arguments->resume, ParseDevice(arguments->device)};
              CheckOutputFolder(place.directory, RunOutput(), DataOf(resolved, place));
              if (place.resume && std::filesystem::exists(place.directory / "manifest.json"))
                CheckDataIsThere(resolved, place.directory);
              FolderCache databases;
              systems::LoadTrainingLibrary().at(system->name).train(resolved, place, databases, TaskOfProcess());
            };
          }};
}

}  // namespace daumier::cli
