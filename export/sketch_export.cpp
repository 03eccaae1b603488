#include "export/sketch_export.h"

#include "core/error.h"
#include "core/files.h"
#include "core/log.h"
#include "core/manifest.h"
#include "export/model_card.h"
#include "export/onnx_export.h"
#include "export/parity.h"
#include "export/staged_directory.h"
#include "faces/face_database.h"
#include "models/sketch_run.h"

namespace daumier::exporting {
namespace {

namespace fs = std::filesystem;

std::optional<Json> ReadMetrics(const fs::path& run_directory) {
  const fs::path file = run_directory / "report" / "metrics.json";
  if (!fs::exists(file)) return std::nullopt;
  const Json metrics = Json::parse(ReadFile(file), nullptr, /*allow_exceptions=*/false);
  DAUMIER_CHECK(metrics.is_object(), "{} is no JSON object; run `daumier eval` again", file.string());
  return metrics;
}

}  // namespace

ExportedFunction SketchFunction(models::SketchNetwork network) {
  const int64_t side = network->options().resolution, num_vertices = network->num_vertices();
  return {"sketch",
          "sketch",
          {1, side, side},
          {"u", "v", "vertices"},
          [network, num_vertices](const torch::Tensor& sketch) mutable {
            const auto coefficients = network->forward(sketch);
            const auto vertices = network->Decode(coefficients).reshape({-1, num_vertices, 3});
            return std::vector<torch::Tensor>{coefficients.u, coefficients.v, vertices};
          }};
}

Json ExportSketchRun(const fs::path& run_directory, const fs::path& out_directory) {
  const auto run = models::LoadSketchRun(run_directory);
  const auto metrics = ReadMetrics(run_directory);
  const auto function = SketchFunction(run.network);
  StagedDirectory staged(out_directory, "export");

  Manifest manifest;
  manifest.kind = "export";
  manifest.verb = "export";
  manifest.config = run.manifest.config;
  manifest.seed = run.manifest.seed;
  manifest.sources = run.manifest.sources;
  manifest.counts = {{"vertices", run.network->num_vertices()}, {"parameters", run.network->num_parameters()}};
  manifest.details = {{"opset", kOpset}, {"run_data_hash", DataHash(run_directory)}};
  const auto write = [&](const std::string& name, const std::string& bytes) {
    WriteFileAtomically(staged.path() / name, bytes);
    manifest.checksums[name] = Sha256(bytes);
  };
  write("model.onnx", ExportToOnnx(*run.network, function).SerializeAsString());

  const fs::path scratch = staged.path() / "scratch";
  MakeDirectory(scratch);
  const auto parity = CheckParity(staged.path() / "model.onnx", function, run.manifest.seed, scratch);
  fs::remove_all(scratch);
  if (!parity.runtime.has_value()) {
    log::Warn(
        "The exported model was not compared with LibTorch, for there is no ONNX Runtime: install it by `./dev setup`");
  }
  const Json report = ParityToJson(parity);
  write("parity.json", report.dump(2) + "\n");
  write("model_card.md", ModelCard(run, parity, metrics));
  manifest.checksums.merge(faces::WriteFaceTemplate(staged.path(), run.face_template));
  WriteManifest(staged.path(), manifest);
  staged.Commit();
  return report;
}

}  // namespace daumier::exporting
