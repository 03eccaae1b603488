#pragma once
#include "ablation/runs.h"
#include "core/error.h"
#include "core/files.h"
#include "core/interrupt.h"
#include "core/manifest.h"
#include "core/options.h"
#include "reports/evaluation.h"
#include "tests/support/synthetic_face.h"
#include "tests/support/temp_dir.h"

#include <functional>
#include <map>
#include <optional>
#include <vector>

namespace daumier::ablation {

/// A database that holds nothing and counts how often it is opened.
struct FakeDatabase {
  explicit FakeDatabase(const std::filesystem::path& folder) {
    ReadManifest(folder, "faces");
    ++num_opened;
  }
  inline static int num_opened = 0;
};

/// A system whose runs learn nothing: their config has the error that their network will have.
class FakeSystem {
 public:
  struct Split {
    std::string kind;

    template <class V>
    void Visit(V&& visit) {
      visit("kind", kind, Text{}, "Split.");
    }
  };
  struct Data {
    std::string faces;

    template <class V>
    void Visit(V&& visit) {
      visit("faces", faces, Text{}, "Folder.");
    }
  };
  struct Config {
    Data data;
    double error = 1;
    uint64_t seed = 0;
    Split split;

    template <class V>
    void Visit(V&& visit) {
      visit("data", data, Table{}, "Data.");
      visit("error", error, Range{0, 100}, "Of the run.");
      visit("seed", seed, Range{0, 100}, "Seed.");
      visit("split", split, Table{}, "Split.");
    }
  };
  struct Eval {
    double factor = 1;
    std::string recover_with;

    template <class V>
    void Visit(V&& visit) {
      visit("factor", factor, Range{0, 100}, "Of the error.");
      visit("recover_with", recover_with, Text{}, "A run.");
    }
  };

  /// Forgets what earlier tests did and writes the database.
  FakeSystem() {
    state() = {};
    FakeDatabase::num_opened = 0;
    Manifest manifest{.kind = "faces", .verb = "dataset faces"};
    MakeDirectory(folder_ / "faces");
    WriteManifest(folder_ / "faces", manifest);
    state().faces = (folder_ / "faces").string();
  }

  struct State {
    std::string faces;
    std::vector<std::string> log;  ///< "train 2", "evaluate 2": with the error of the run.
    int num_faces = 4;
    std::map<double, std::function<void()>> end_of_training, end_of_evaluation;  ///< By the error of the run.
    bool keep_predictions = true;
  };
  static State& state() {
    static State state;
    return state;
  }

  static AblationSystem system() {
    static const systems::System plain{.name = "fake",
                                       .room = "tests/ablation",
                                       .training_help = nullptr,
                                       .evaluation_help = nullptr,
                                       .resolve_config = ResolveConfig,
                                       .resolve_evaluation = ResolveEvaluation,
                                       .read_metrics = ReadMetrics,
                                       .summary_columns = Columns,
                                       .run_options = {"recover_with"}};
    static const systems::SystemTraining training{.name = "fake",
                                                  .train = Train,
                                                  .evaluate = Evaluate,
                                                  .describe_export = nullptr,
                                                  .infer_ms = [](const std::filesystem::path&) { return 2.5; },
                                                  .validation_metric = "error"};
    return {plain, training};
  }

 private:
  static Json ResolveConfig(const Json& config, const std::string& where) {
    auto options = ParseOptions<Config>(config, where);
    options.data.faces = state().faces;
    return ToJson(options);
  }
  static Json ResolveEvaluation(const Json& eval, const std::string& where) {
    return ToJson(ParseOptions<Eval>(eval, where));
  }
  static std::vector<reports::Metric> Columns() {
    return {{.key = "p90", .title = "p90", .may_hide = true, .of_key = "error", .percentile = 90}};
  }

  static TrainingSummary Train(const Json& config, const systems::RunPlace& place, FolderCache& databases,
                               const Task&) {
    const auto options = ParseOptions<Config>(config);
    databases.Open<FakeDatabase>(options.data.faces);
    state().log.push_back(fmt::format("{} {}", place.resume ? "resume" : "train", options.error));
    MakeDirectory(place.directory);
    Manifest manifest{.kind = "run", .verb = "train"};
    manifest.config = config;
    manifest.config.erase("data");
    manifest.details["data"] = {{"faces", DataHash(options.data.faces)}};
    WriteManifest(place.directory, manifest);
    WriteFileAtomically(place.directory / "metrics.jsonl", Lines(options.error));
    if (const auto end = state().end_of_training.find(options.error); end != state().end_of_training.end())
      end->second();
    manifest.counts = {{"steps", 10}, {"parameters", 7}, {"best_epoch", 1}};
    manifest.checksums = {{"best/model.safetensors", fmt::format("weights {}", config.dump())}};
    WriteManifest(place.directory, manifest);
    return {};
  }

  /// Faces of two persons, whose errors lie 0.1 below and above the mean.
  static reports::Evaluation Evaluate(const std::filesystem::path& run, const Json& eval, FolderCache& databases,
                                      const Task&) {
    const auto options = ParseOptions<Eval>(eval);
    const auto config = ParseOptions<Config>(ReadManifest(run, "run").config);
    databases.Open<FakeDatabase>(state().faces);
    state().log.push_back(fmt::format("evaluate {}", config.error));
    if (!options.recover_with.empty()) ReadManifest(options.recover_with, "run");
    if (const auto end = state().end_of_evaluation.find(config.error); end != state().end_of_evaluation.end())
      end->second();
    reports::Evaluation evaluation;
    reports::MetricTable& table = evaluation.table;
    table = EmptyTable();
    for (int face = 0; face < state().num_faces; ++face) table.faces.push_back(face), table.groups.push_back(face % 2);
    const auto add = [&](const std::string& name, double error) {
      std::vector<double> errors;
      for (int face = 0; face < state().num_faces; ++face) errors.push_back(error + (face % 2 == 0 ? -0.1 : 0.1));
      table.rows.push_back(reports::MakeRow(table, name, {{"error", errors}}, 1));
      table.rows.back().input = "none";
    };
    add("network", options.factor * config.error + 0.01 * double(config.seed));
    add("fit", 5);
    add("mean face", 9);
    table.rows.back().baseline = true;
    evaluation.metrics = {{"num_faces", state().num_faces}, {"split", "test"},        {"table", TableJson(table)},
                          {"faces", table.faces},           {"groups", table.groups}, {"data_hash", {{"faces", "f"}}}};
    Draw(evaluation);
    evaluation.manifest.kind = "report";
    evaluation.manifest.verb = "eval";
    return evaluation;
  }

  static void Draw(reports::Evaluation& evaluation) {
    const faces::FaceTemplate face = testing::SyntheticFace();
    const double error = evaluation.table.rows[0].error().mean;
    reports::Predictions predictions{reports::SurfaceOf(face), {}};
    for (const int index : evaluation.table.faces)
      predictions.faces.push_back(
          {index, {}, face.neutral, face.neutral, Eigen::VectorXd::Constant(face.num_vertices(), error)});
    evaluation.sheet = reports::Evaluation::Sheet{render::Image(8, 8, 3), "Nothing."};
    if (state().keep_predictions) evaluation.predictions = std::move(predictions);
  }

  static reports::MetricTable EmptyTable() {
    reports::MetricTable table{
        .columns = {{.key = "error", .title = "mm", .unit = "mm", .interval = reports::ShowInterval::kInColumn}}};
    table.columns.push_back(Columns()[0]);
    return table;
  }
  static reports::MetricTable ReadMetrics(const Json& metrics) {
    return reports::TableFromMetrics(metrics, EmptyTable().columns, "a run");
  }

  static std::string Lines(double error) {
    std::string lines;
    for (int step = 5; step <= 10; step += 5) {
      lines += Json{{"step", step}, {"phase", "train"}, {"loss", 1}, {"seconds", 0.5 * step}}.dump() + "\n";
      lines += Json{{"step", step}, {"phase", "validation"}, {"error", error + 1.0 / step}, {"seconds", 0.5 * step + 1}}
                   .dump() +
               "\n";
    }
    return lines;
  }

  const testing::TempDir folder_;
};

}  // namespace daumier::ablation
