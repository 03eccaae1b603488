#include "export/run_export.h"

#include "core/error.h"
#include "core/files.h"
#include "core/log.h"
#include "core/run_manifest.h"
#include "core/staged_directory.h"
#include "export/onnx_export.h"
#include "export/onnx_graph.h"

namespace daumier::exporting {
namespace fs = std::filesystem;

std::optional<Json> ReadRunMetrics(const fs::path& run_directory) {
  const fs::path file = ReportMetrics(run_directory);
  if (!fs::exists(file)) return std::nullopt;
  std::optional<Json> metrics = TryParseJson(ReadFile(file));
  DAUMIER_CHECK(metrics && metrics->is_object(), "{} is no JSON object; run `daumier eval` again", file.string());
  return metrics;
}

ExportedFunction FunctionWithSamples(const RunExport& run) {
  ExportedFunction function = run.function;
  if (run.find_samples) run.find_samples(function);
  return function;
}

Json WriteExport(const RunExport& run, const fs::path& out_directory) {
  const auto metrics = ReadRunMetrics(run.run_directory);
  StagedDirectory staged(out_directory, "export");

  Manifest manifest;
  manifest.kind = "export";
  manifest.verb = "export";
  manifest.config = run.run_manifest.config;
  manifest.seed = run.run_manifest.seed;
  manifest.sources = run.run_manifest.sources;
  manifest.counts = run.counts;
  manifest.details = run.details;
  manifest.details["opset"] = kOpset;
  manifest.details["run_data_hash"] = DataHash(run.run_directory);
  const auto write = [&](const std::string& name, const std::string& bytes) {
    WriteFileAtomically(staged.path() / name, bytes);
    manifest.checksums[name] = Sha256(bytes);
  };
  write("model.onnx", ExportToOnnx(*run.module, run.function).SerializeAsString());

  const fs::path scratch = staged.path() / "scratch";
  MakeDirectory(scratch);
  const auto parity =
      CheckParity(staged.path() / "model.onnx", FunctionWithSamples(run), run.run_manifest.seed, scratch);
  fs::remove_all(scratch);
  if (!parity.runtime.has_value()) {
    log::Warn(
        "The exported model was not compared with LibTorch, for there is no ONNX Runtime: install it by `./dev setup`");
  }
  const Json report = ParityToJson(parity);
  write("parity.json", report.dump(2) + "\n");
  write("model_card.md", ModelCard(run.card, run.run_manifest, parity, metrics));
  if (run.write_rest) manifest.checksums.merge(run.write_rest(staged.path()));
  WriteManifest(staged.path(), manifest);
  staged.Commit();
  return report;
}

void StoreGraph(const RunExport& run) {
  const std::string bytes = ExportToOnnx(*run.module, run.function).SerializeAsString();
  WriteFileIfChanged(run.run_directory / kBestGraph, bytes);
  Manifest manifest = ReadManifest(run.run_directory, "run");
  manifest.checksums[kBestGraph] = Sha256(bytes);
  WriteManifest(run.run_directory, manifest);
}

}  // namespace daumier::exporting
