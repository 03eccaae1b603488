#include "cli/system_table.h"
#include "cli/verb.h"
#include "core/output_place.h"
#include "core/process_task.h"
#include "systems/training_library.h"

#include <fmt/core.h>

#include <memory>

namespace daumier::cli {

Verb ExportVerb() {
  return {"export", "Write a run as ONNX with parity report and model card",
          [](CLI::App& command) {
            struct Arguments {
              std::filesystem::path run, out;
              bool as_json = false;
            };
            auto arguments = std::make_shared<Arguments>();
            command.add_option("run", arguments->run, "Run folder")->required();
            command.add_option("--out", arguments->out, "Folder to write")->required();
            command.add_flag("--json", arguments->as_json, "Machine-readable");
            return [arguments] {
              SystemOfRun(arguments->run);  // What is no run of a known task is refused before the library is loaded.
              CheckReplacedFolder(arguments->out, "export", {arguments->run});
              const systems::TrainingLibrary& library = systems::LoadTrainingLibrary();
              PrintResult(library.export_run(arguments->run, arguments->out, TaskOfProcess()), arguments->as_json);
              if (!arguments->as_json) fmt::print("export: {}\n", (arguments->out / "model.onnx").string());
            };
          },
          /*keeps_freed_memory=*/false};
}

}  // namespace daumier::cli
