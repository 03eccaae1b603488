#include "cli/verb.h"
#include "core/manifest.h"
#include "systems/deform/train/export.h"
#include "systems/deform/train/run.h"
#include "systems/sketch/train/export.h"

#include <memory>

namespace daumier::cli {
namespace {

Json ExportRun(const std::filesystem::path& run, const std::filesystem::path& out) {
  const bool is_deform = std::filesystem::exists(run / "manifest.json") &&
                         deform::ProductOf(ReadManifest(run, "run")) == deform::kDeformProduct;
  return is_deform ? deform::ExportDeformRun(run, out) : sketch::ExportSketchRun(run, out);
}

}  // namespace

Verb ExportVerb() {
  return {"export", "Write a run as ONNX with parity report and model card", [](CLI::App& command) {
            struct Arguments {
              std::filesystem::path run, out;
              bool as_json = false;
            };
            auto arguments = std::make_shared<Arguments>();
            command.add_option("run", arguments->run, "Run folder")->required();
            command.add_option("--out", arguments->out, "Folder to write")->required();
            command.add_flag("--json", arguments->as_json, "Machine-readable");
            return
                [arguments] { PrintResult(ExportRun(arguments->run, arguments->out), arguments->as_json); };
          }};
}

}  // namespace daumier::cli
