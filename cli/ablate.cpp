#include "cli/config_kind.h"
#include "cli/system_table.h"
#include "cli/verb.h"
#include "core/files.h"
#include "core/output_place.h"
#include "core/process_task.h"
#include "systems/training_library.h"

#include <fmt/core.h>

#include <memory>

namespace daumier::cli {
namespace {

void PrintPlan(const Json& plan, bool as_json) {
  if (as_json) {
    fmt::print("{}\n", plan.dump(2));
    return;
  }
  for (const Json& step : plan) {
    fmt::print("seed {}  {:<8} {:<28} {}\n", step.at("seed").get<uint64_t>(), step.at("split").get<std::string>(),
               step.at("row").get<std::string>(), step.at("state").get<std::string>());
  }
}

}  // namespace

Verb AblateVerb() {
  return {
      "ablate", "Train and evaluate every row of a table", [](CLI::App& command) {
        struct Arguments {
          systems::AblationRequest request;
          std::string device = "cpu";
          bool as_json = false;
        };
        auto arguments = std::make_shared<Arguments>();
        systems::AblationRequest& request = arguments->request;
        command.add_option("config", request.config, "TOML file of the table")->required();
        command.add_option(
            "overrides", request.overrides,
            "key=value or table.key=value, in TOML syntax: options of every run, or seeds, splits, eval.*");
        command.add_option("-o,--out", request.out, "Folder of runs, reports, table and pictures")->required();
        command
            .add_option("--only", request.only,
                        "Name of a row to make, with the rows that it needs; repeat --only for more rows")
            ->allow_extra_args(false);
        command.add_option("--device", arguments->device, "cpu or cuda")->capture_default_str();
        command.add_flag("--dry-run", request.dry_run,
                         "Print which rows are finished and which would be made; make none");
        command.add_flag("--json", arguments->as_json, "Print the result as JSON");
        command.footer(
            "[config] and [eval] of the table or of a row override the base config and the defaults of `daumier eval`; "
            "docs/formats.md lists the options of the table and of its [[rows]].");
        return [arguments] {
          systems::AblationRequest request = arguments->request;
          request.device = ParseDevice(arguments->device);
          CheckOutputFolder(request.out, systems::AblationOutput());
          const systems::TrainingLibrary& library = systems::LoadTrainingLibrary();
          const systems::System& system = ReadConfigOf("ablate", request.config, [&]() -> const systems::System& {
            return SystemOfConfig(library.ablation_config(request));
          });
          const Json result = library.ablate(request, system, TaskOfProcess());
          if (request.dry_run) return PrintPlan(result, arguments->as_json);
          if (arguments->as_json) {
            fmt::print("{}\n", result.dump(2));
          } else {
            fmt::print("{}\npictures: {}\n", ReadFile(request.out / "table.md"), (request.out / "index.html").string());
          }
        };
      }};
}

}  // namespace daumier::cli
