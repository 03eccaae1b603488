#include "cli/system_table.h"
#include "cli/verb.h"
#include "core/error.h"
#include "core/output_place.h"
#include "core/process_task.h"
#include "core/run_manifest.h"
#include "core/weights_folder.h"
#include "datasets/read/run_data.h"
#include "systems/training_library.h"

#include <fmt/core.h>

#include <memory>
#include <string>
#include <vector>

namespace daumier::cli {
namespace {

/// @throws UsageError on options other than data.*; Error if a folder there is not the data of the run.
void CheckData(const std::filesystem::path& run, const Json& options) {
  for (const auto& [key, data] : options.items()) {
    if (key != "data" || !data.is_object())
      throw UsageError(fmt::format("export: unknown option '{}' (expected data.KIND=FOLDER)", key));
    const Manifest manifest = ReadManifest(run, "run");
    const Json config = ReadRunConfig(run, manifest);
    for (const auto& [kind, folder] : data.items()) {
      if (!folder.is_string())
        throw UsageError(fmt::format("export: data.{} is {}, expected a text", kind, folder.dump()));
      datasets::FindRunData(run, manifest, config, kind, folder.get<std::string>());
    }
  }
}

}  // namespace

Verb ExportVerb() {
  return {"export", "Write a run as ONNX with parity report and model card, or as weights to ship",
          [](CLI::App& command) {
            struct Arguments {
              std::filesystem::path run, out, recipe, notes;
              std::vector<std::string> overrides;
              bool as_json = false, as_weights = false;
            };
            auto arguments = std::make_shared<Arguments>();
            command.add_option("run", arguments->run, "Run folder")->required();
            command.add_option(
                "overrides", arguments->overrides,
                "data.faces=FOLDER and the like, if the run's data have moved; only their data hashes are compared, "
                "since an export reads no data");
            command.add_option("-o,--out", arguments->out, "Folder to write")->required();
            CLI::Option* weights =
                command.add_flag("--weights", arguments->as_weights,
                                 "Write the run as weights to ship, in float16 with a card, instead of as ONNX; needs "
                                 "the report of `daumier eval`");
            command
                .add_option("--recipe", arguments->recipe,
                            "With --weights: JSON file, a list of {command, seconds} of which the run is the result")
                ->needs(weights);
            command
                .add_option("--notes", arguments->notes,
                            "With --weights: Markdown file for the card, such as known failures")
                ->needs(weights);
            command.add_flag("--json", arguments->as_json, "Print the result as JSON");
            return [arguments] {
              SystemOfRun(arguments->run);  // What is no run of a known task is refused before the library is loaded.
              CheckData(arguments->run, ConfigArguments{{}, arguments->overrides}.Load());
              CheckReplacedFolder(arguments->out, arguments->as_weights ? kWeightsKind : "export",
                                  {arguments->run, arguments->recipe, arguments->notes});
              const systems::TrainingLibrary& library = systems::LoadTrainingLibrary();
              if (arguments->as_weights) {
                PrintResult(library.write_weights({arguments->run, arguments->out, arguments->recipe, arguments->notes},
                                                  TaskOfProcess()),
                            arguments->as_json);
                if (!arguments->as_json) fmt::print("weights: {}\n", arguments->out.string());
                return;
              }
              PrintResult(library.export_run(arguments->run, arguments->out, TaskOfProcess()), arguments->as_json);
              if (!arguments->as_json) fmt::print("export: {}\n", (arguments->out / "model.onnx").string());
            };
          },
          /*keeps_freed_memory=*/false};
}

}  // namespace daumier::cli
