#include "ablation/runs.h"

#include "core/error.h"
#include "core/files.h"
#include "core/log.h"
#include "train/run_folder.h"
#include "train/run_log.h"

#include <ATen/Parallel.h>

#include <algorithm>

namespace daumier::ablation {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMeasuredFile = "measured.json";

/// The checksum of the weights of a finished run.
std::string WeightsOf(const fs::path& run) {
  const Manifest manifest = ReadManifest(run, "run");
  const auto found = manifest.checksums.find(kBestFile);
  DAUMIER_CHECK(found != manifest.checksums.end(), "{}: its manifest has no checksum of {}", run.string(), kBestFile);
  return found->second;
}

Json ResolvedEval(const systems::System& system, const AblationRow& row) {
  return system.resolve_evaluation(row.eval, fmt::format("eval of row '{}'", row.name()));
}

}  // namespace

AblationRuns::AblationRuns(const Ablation& ablation, const AblationSystem& system, const fs::path& directory)
    : ablation_(ablation), system_(system), directory_(directory) {
  for (const AblationRow& row : ablation.rows) {
    if (row.evaluates()) ResolvedEval(system_.system, row);
    if (!row.trains()) continue;
    for (const std::string& split : ablation.options.splits) Config({row, split, ablation.options.seeds.front()});
  }
}

fs::path AblationRuns::Folder(const Cell& cell) const {
  return directory_ / FolderName(cell.split) / fmt::format("seed{}", cell.seed) / FolderName(cell.row.name());
}

AblationRuns::Cell AblationRuns::CellOf(const Cell& cell, const std::string& row) const {
  return {ablation_.row(row, fmt::format("row '{}'", cell.row.name())), cell.split, cell.seed};
}

Json AblationRuns::Config(const Cell& cell) const {
  Json config = cell.row.config;
  config.merge_patch({{"seed", cell.seed}, {"split", {{"kind", cell.split}}}});
  return system_.system.resolve_config(config, fmt::format("config of row '{}'", cell.row.name()));
}

fs::path AblationRuns::Run(const Cell& cell) const {
  if (!cell.row.options.run_of.empty()) return Run(CellOf(cell, cell.row.options.run_of));
  if (!cell.row.options.from.empty()) return Run(CellOf(cell, cell.row.options.from));
  return Folder(cell) / "run";
}

bool AblationRuns::Finished(const fs::path& run, const Json& config) const {
  Json hashes;
  for (const auto& [database, folder] : config.at("data").items())
    hashes[database] = DataHash(folder.get<std::string>());
  const Json defaults = system_.system.resolve_config({{"data", config.at("data")}}, run.string());
  train::OpenRunFolder(run, /*resume=*/true, train::WithoutPaths(config), hashes, defaults);
  return ReadManifest(run, "run").counts.contains("best_epoch");
}

Json AblationRuns::Eval(const Cell& cell) const {
  Json eval = ResolvedEval(system_.system, cell.row);
  for (const std::string& key : system_.system.run_options)
    if (const std::string name = eval.value(key, ""); !name.empty()) eval[key] = Run(CellOf(cell, name)).string();
  return eval;
}

Json AblationRuns::MadeOf(const Cell& cell) const {
  Json made_of = {{"eval", ResolvedEval(system_.system, cell.row)}, {"weights", WeightsOf(Run(cell))}};
  for (const std::string& key : system_.system.run_options)
    if (const std::string name = made_of["eval"].value(key, ""); !name.empty())
      made_of["eval"][key] = {{"row", name}, {"weights", WeightsOf(Run(CellOf(cell, name)))}};
  return made_of;
}

Json AblationRuns::RecordedMadeOf(const Json& measured, const Cell& cell) const {
  Json made_of = measured.value("made_of", Json());
  if (!made_of.is_object() || !made_of.contains("eval")) return made_of;
  Json options = made_of["eval"], runs = Json::object();
  for (const std::string& key : system_.system.run_options) {
    if (!options.contains(key)) continue;
    runs[key] = options[key];
    options.erase(key);
  }
  try {
    made_of["eval"] = system_.system.resolve_evaluation(options, cell.Describe());
  } catch (const UsageError&) {
    return nullptr;  // An option that exists no longer.
  }
  for (const auto& [key, value] : runs.items()) made_of["eval"][key] = value;
  return made_of;
}

RowState AblationRuns::State(const Cell& cell) const {
  const AblationRowOptions& row = cell.row.options;
  if (!row.from.empty()) return State(CellOf(cell, row.from));
  if (cell.row.trains()) {
    const fs::path run = Folder(cell) / "run";
    if (!fs::exists(run / "manifest.json")) return fs::exists(run) ? RowState::kToResume : RowState::kToTrain;
    if (!Finished(run, Config(cell))) return RowState::kToResume;
    if (!ablation_.options.evaluate) return RowState::kDone;
  }
  for (const std::string& name : NeededRows(cell.row, system_.system.run_options)) {
    if (name == cell.row.name()) continue;
    const RowState needed = State(CellOf(cell, name));
    if (needed == RowState::kToTrain || needed == RowState::kToResume)
      return cell.row.trains() ? RowState::kToEvaluate : needed;
  }
  const fs::path measured = Folder(cell) / kMeasuredFile;
  if (!fs::exists(measured) || !fs::exists(Folder(cell) / "report" / "metrics.json")) return RowState::kToEvaluate;
  return RecordedMadeOf(ReadJson(measured), cell) == MadeOf(cell) ? RowState::kDone : RowState::kToEvaluate;
}

void AblationRuns::Train(const Cell& cell, FolderCache& databases, const Task& task) const {
  if (!cell.row.trains()) return;
  const fs::path run = Folder(cell) / "run";
  const Json config = Config(cell);
  if (fs::exists(run / "manifest.json") && Finished(run, config)) return;
  const bool begun = fs::exists(run / "resolved.toml") || fs::exists(run / "manifest.json");
  system_.training.train(config, {.directory = run, .resume = begun, .device = system_.device}, databases, task);
}

void AblationRuns::Evaluate(const Cell& cell, FolderCache& databases, const Task& task) const {
  if (!ablation_.options.evaluate || !cell.row.evaluates() || State(cell) == RowState::kDone) return;
  log::Info("Evaluating {}", cell.Describe());
  const fs::path run = Run(cell), report = Folder(cell) / "report";
  const reports::Evaluation evaluation = system_.training.evaluate(run, Eval(cell), databases, task);
  if (!fs::exists(report / "manifest.json")) fs::remove_all(report);  // Of an earlier version that was killed.
  reports::WriteEvaluation(report, evaluation);
  const Json measured = {{"format_version", 1},
                         {"made_of", MadeOf(cell)},
                         {"infer_ms", system_.training.infer_ms(run)},
                         {"infer_threads", at::get_num_threads()}};
  WriteFileAtomically(Folder(cell) / kMeasuredFile, measured.dump(2) + "\n");
}

AblationRuns::Cell AblationRuns::Reported(const Cell& cell) const {
  return cell.row.evaluates() ? cell : CellOf(cell, cell.row.options.from);
}

Json AblationRuns::Metrics(const Cell& cell) const {
  return reports::ReadMetrics(Folder(Reported(cell)) / "report");
}

reports::MetricTable AblationRuns::Table(const Cell& cell) const {
  return system_.system.read_metrics(Metrics(cell));
}

std::optional<reports::Predictions> AblationRuns::Predictions(const Cell& cell) const {
  return reports::ReadReportPredictions(Folder(Reported(cell)) / "report");
}

RunCost AblationRuns::Cost(const Cell& cell) const {
  const fs::path run = Run(cell);
  const Manifest manifest = ReadManifest(run, "run");
  try {
    RunCost cost{.steps = manifest.counts.at("steps").get<int64_t>(),
                 .parameters = manifest.counts.at("parameters").get<int64_t>(),
                 .train_seconds = TrainSeconds(run)};
    if (!ablation_.options.evaluate) return cost;
    const Json measured = ReadJson(Folder(Reported(cell)) / kMeasuredFile);
    cost.inference = RunCost::Inference{measured.at("infer_ms").get<double>(), measured.at("infer_threads").get<int>()};
    return cost;
  } catch (const Json::exception& error) {
    throw Error(fmt::format("{} or its {} is malformed: {}", run.string(), kMeasuredFile, error.what()));
  }
}

AblationMeasure AblationRuns::Validation(const Cell& cell) const {
  const std::string metric(system_.training.validation_metric);
  const RunCurve curve = ReadCurve(Run(cell), "validation", metric);
  DAUMIER_CHECK(!curve.errors.empty(), "{} has no '{}' of validation faces", Run(cell).string(), metric);
  AblationMeasure measure{.error = *std::min_element(curve.errors.begin(), curve.errors.end()), .of_run = true};
  measure.more = {{"measured_on", "validation"}};
  return measure;
}

AblationResult AblationRuns::Result(const Cell& cell) const {
  const AblationRowOptions& row = cell.row.options;
  AblationResult result{.name = row.name, .split = cell.split, .seed = cell.seed, .paper = row.paper};
  try {
    if (ablation_.options.evaluate) {
      const reports::MetricTable table = Table(cell);
      result.measure = MeasureOf(table, reports::FindRow(table, row.line, row.input));
    } else {
      result.measure = Validation(cell);
    }
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", cell.Describe(), error.what()));
  }
  if (result.measure.of_run) result.cost = Cost(cell);
  return result;
}

std::vector<AblationResult> AblationRuns::Baselines(const Cell& cell) const {
  if (!ablation_.options.evaluate) return {};
  const reports::MetricTable table = Table(cell);
  std::vector<AblationResult> results;
  for (const reports::MetricRow& row : table.rows) {
    if (!row.baseline) continue;
    results.push_back(
        {.name = row.name, .split = cell.split, .seed = cell.seed, .baseline = true, .measure = MeasureOf(table, row)});
  }
  return results;
}

double TrainSeconds(const fs::path& run) {
  const std::vector<train::MetricsRecord> records = train::ReadMetrics(run);
  return records.empty() ? 0 : records.back().seconds;
}

RunCurve ReadCurve(const fs::path& run, const std::string& phase, const std::string& metric) {
  RunCurve curve;
  for (const auto& [line, seconds] : train::ReadMetrics(run)) {
    if (line.value("phase", "") != phase || !line.contains(metric)) continue;
    curve.steps.push_back(line.at("step").get<double>());
    curve.errors.push_back(line.at(metric).get<double>());
    curve.seconds.push_back(seconds);
  }
  return curve;
}

std::optional<double> LeastWithin(const RunCurve& curve, double seconds) {
  std::optional<double> least;
  for (size_t i = 0; i < curve.errors.size(); ++i)
    if (curve.seconds[i] <= seconds && (!least || curve.errors[i] < *least)) least = curve.errors[i];
  return least;
}

}  // namespace daumier::ablation
