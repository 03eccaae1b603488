#include "systems/expression/train/system.h"

#include "core/files.h"
#include "core/median_time.h"
#include "core/run_manifest.h"
#include "core/runtime.h"
#include "datasets/read/run_data.h"
#include "export/run_export.h"
#include "reports/face_pictures.h"
#include "systems/expression/options.h"
#include "systems/expression/system.h"
#include "systems/expression/train/recipe.h"
#include "tensor/module_state.h"
#include "tensor/runtime.h"
#include "train/precision.h"
#include "train/train_run.h"

#include <torch/utils.h>

namespace daumier::expression {
namespace {

namespace fs = std::filesystem;

struct Run {
  Manifest manifest;
  Json config;
  ExpressionNetwork network{nullptr};
  int64_t num_vertices = 0;
};

Run LoadRun(const fs::path& directory) {
  Run run{.manifest = ReadFinishedRun(directory, kSystem), .config = {}};
  run.config = ReadRunConfig(directory, run.manifest);
  run.num_vertices = run.manifest.details.at("vertices").get<int64_t>();
  run.network = ExpressionNetwork(ParseOptions<NetworkOptions>(run.config.at("network"), "network"), run.num_vertices,
                                  int64_t(run.manifest.details.at("expressions").size()));
  tensor::LoadModule(BestWeights(directory), *run.network);
  run.network->eval();
  return run;
}

exporting::RunExport DescribeExport(const fs::path& directory) {
  const Run run = LoadRun(directory);
  const int64_t size = 3 * run.num_vertices;
  const auto sample = [size](int64_t batch, Rng& rng) {
    torch::Tensor vertices = torch::empty({batch, size});
    for (int64_t i = 0; i < batch * size; ++i) vertices.data_ptr<float>()[i] = float(10 * rng.Normal());
    return vertices;
  };
  ExpressionNetwork network = run.network;
  return {.run_directory = directory,
          .run_manifest = run.manifest,
          .module = network.ptr(),
          .function = {.name = kSystem,
                       .inputs = {{"vertices", {size}, sample}},
                       .output_names = {"scores"},
                       .forward =
                           [network](const std::vector<torch::Tensor>& inputs) mutable {
                             return std::vector<torch::Tensor>{network->forward(inputs[0])};
                           }},
          .card = {.title = "Classifier of expressions",
                   .summary = "Two layers that read the vertices of a face: which expression it shows.",
                   .inputs_and_outputs = "`vertices` (N, 3V) float32, x0 y0 z0 x1 ... in cm; `scores` (N, E) float32, "
                                         "without softmax.\n\n",
                   .limits = {"It reads faces of one topology."}},
          .counts = {{"vertices", run.num_vertices}},
          .details = {{"expressions", run.manifest.details.at("expressions")}}};
}

TrainingSummary Train(const Json& config, const systems::RunPlace& place, FolderCache& databases, const Task& task) {
  auto options = ParseTraining<TrainingOptions>(config, "training config");
  const torch::Device device = tensor::TorchDevice(place.device);
  options.trainer.precision =
      train::ResolvePrecision(options.trainer.precision, place.directory, device, HasBfloat16Instructions());
  const auto& faces = databases.Open<faces::FaceDatabase>(options.data.faces);
  const datasets::Split split = datasets::MakeSplit(faces, options.split, options.seed);

  Manifest manifest = datasets::ManifestOfTraining(ToJson(options), options.seed, faces, split);
  manifest.details["system"] = kSystem;
  manifest.details["data"] = {{"faces", DataHash(options.data.faces)}};
  manifest.details["expressions"] = faces.expression_names();
  manifest.details["vertices"] = faces.num_vertices();
  train::StartRun(place.directory, place.resume, {ToJson(options), ToJson(TrainingOptions()), manifest});

  torch::manual_seed(options.seed);
  ExpressionRecipe recipe(options, faces, split, device);
  TrainingSummary summary =
      train::TrainRun(recipe, options.trainer, options.optimiser, options.seed, place.directory, task);
  exporting::StoreGraph(DescribeExport(place.directory));
  return summary;
}

/// Up to 12 of the faces, with what each is taken for.
reports::Evaluation::Sheet SheetOf(const faces::FaceDatabase& faces, const std::vector<int>& indices,
                                   const std::vector<int64_t>& predicted) {
  constexpr size_t kMost = 12;
  constexpr int kColumns = 4;
  const std::vector<int> shown(indices.begin(), indices.begin() + std::ptrdiff_t(std::min(kMost, indices.size())));
  const faces::FinishedHead head(faces.face_template());
  const render::Frame frame = reports::FrameOfFaces(faces, shown);
  std::vector<render::SheetCell> cells;
  for (size_t i = 0; i < shown.size(); ++i) {
    const auto& names = faces.expression_names();
    cells.push_back({reports::FrontView(head, faces.points(shown[i]), frame),
                     names[size_t(faces.id(shown[i]).expression)] + ": " + names[size_t(predicted[i])]});
  }
  return {render::MakeSheet(cells, kColumns), "What faces show, and what the network takes them for."};
}

reports::Evaluation Evaluate(const fs::path& directory, const Json& json, FolderCache& databases, const Task&) {
  const auto options = ParseOptions<EvalOptions>(json);
  Run run = LoadRun(directory);
  const auto& faces = databases.Open<faces::FaceDatabase>(
      datasets::FindRunData(directory, run.manifest, run.config, "faces", options.data.faces));
  const datasets::Split split = datasets::SplitOfRun(directory, run.manifest, run.config, faces);
  const std::vector<int> indices = LabelledFaces(faces, datasets::SubsetOf(split, options.split));
  const std::vector<int64_t> predicted = PredictedExpressions(run.network, faces, indices);

  reports::Evaluation evaluation;
  reports::MetricTable& table = evaluation.table;
  table = {.columns = ErrorColumns(), .faces = indices, .data_hash = run.manifest.details.at("data")};
  std::vector<double> wrong, wrong_neutral;
  for (size_t i = 0; i < indices.size(); ++i) {
    const int truth = faces.id(indices[i]).expression;
    wrong.push_back(predicted[i] != truth);
    wrong_neutral.push_back(truth != 0);
    table.groups.push_back(faces.group(indices[i]));
  }
  table.rows.push_back(reports::MakeRow(table, "network", {{"error", wrong}}, run.manifest.seed));
  table.rows.push_back(reports::MakeRow(table, "always neutral", {{"error", wrong_neutral}}, run.manifest.seed));
  table.rows.back().baseline = true;

  evaluation.metrics = {{"system", kSystem},
                        {"split", options.split},
                        {"num_faces", indices.size()},
                        {"table", reports::TableJson(table)},
                        {"data_hash", table.data_hash},
                        {"faces", table.faces},
                        {"groups", table.groups}};
  evaluation.report.title = "Expressions, " + options.split + " split";
  evaluation.report.tables = {reports::TextTable(table)};
  evaluation.sheet = SheetOf(faces, indices, predicted);
  evaluation.manifest.kind = "report";
  evaluation.manifest.verb = "eval";
  evaluation.manifest.config = {{"split", options.split}};
  evaluation.manifest.seed = run.manifest.seed;
  evaluation.manifest.sources = run.manifest.sources;
  evaluation.manifest.details = {
      {"system", kSystem}, {"data", table.data_hash}, {"weights", Sha256OfFile(BestWeights(directory))}};
  return evaluation;
}

double InferMs(const fs::path& directory) {
  const at::NoGradGuard no_grad;
  Run run = LoadRun(directory);
  const torch::Tensor vertices = torch::zeros({1, 3 * run.num_vertices});
  return MedianMs([&] { run.network->forward(vertices); });
}

}  // namespace

systems::SystemTraining ExpressionTraining() {
  return {.name = kSystem,
          .train = Train,
          .evaluate = Evaluate,
          .describe_export = DescribeExport,
          .infer_ms = InferMs,
          .validation_metric = "error_percent"};
}

}  // namespace daumier::expression
