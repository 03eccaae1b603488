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

Json ReadJson(const fs::path& file) {
  try {
    return Json::parse(ReadFile(file));
  } catch (const Json::exception& error) {
    throw Error(fmt::format("{}: not JSON: {}", file.string(), error.what()));
  }
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

fs::path AblationRuns::Folder(const Place& place) const {
  return directory_ / FolderName(place.split) / fmt::format("seed{}", place.seed) / FolderName(place.row.name());
}

AblationRuns::Place AblationRuns::PlaceOf(const Place& place, const std::string& row) const {
  return {ablation_.row(row, fmt::format("row '{}'", place.row.name())), place.split, place.seed};
}

Json AblationRuns::Config(const Place& place) const {
  Json config = place.row.config;
  config.merge_patch({{"seed", place.seed}, {"split", {{"kind", place.split}}}});
  return system_.system.resolve_config(config, fmt::format("config of row '{}'", place.row.name()));
}

fs::path AblationRuns::Run(const Place& place) const {
  if (!place.row.options.run_of.empty()) return Run(PlaceOf(place, place.row.options.run_of));
  if (!place.row.options.from.empty()) return Run(PlaceOf(place, place.row.options.from));
  return Folder(place) / "run";
}

bool AblationRuns::Finished(const fs::path& run, const Json& config) const {
  Json without_paths = config, hashes;
  without_paths.erase("data");
  for (const auto& [database, folder] : config.at("data").items())
    hashes[database] = DataHash(folder.get<std::string>());
  const Json defaults = system_.system.resolve_config({{"data", config.at("data")}}, run.string());
  train::OpenRunFolder(run, /*resume=*/true, without_paths, hashes, defaults);
  return ReadManifest(run, "run").counts.contains("best_epoch");
}

Json AblationRuns::Eval(const Place& place) const {
  Json eval = ResolvedEval(system_.system, place.row);
  for (const std::string& key : system_.system.run_options)
    if (const std::string name = eval.value(key, ""); !name.empty()) eval[key] = Run(PlaceOf(place, name)).string();
  return eval;
}

Json AblationRuns::MadeOf(const Place& place) const {
  Json made_of = {{"eval", ResolvedEval(system_.system, place.row)}, {"weights", WeightsOf(Run(place))}};
  for (const std::string& key : system_.system.run_options)
    if (const std::string name = made_of["eval"].value(key, ""); !name.empty())
      made_of["eval"][key] = {{"row", name}, {"weights", WeightsOf(Run(PlaceOf(place, name)))}};
  return made_of;
}

Json AblationRuns::RecordedMadeOf(const Json& measured, const Place& place) const {
  Json made_of = measured.value("made_of", Json());
  if (!made_of.is_object() || !made_of.contains("eval")) return made_of;
  Json options = made_of["eval"], runs = Json::object();
  for (const std::string& key : system_.system.run_options) {
    if (!options.contains(key)) continue;
    runs[key] = options[key];
    options.erase(key);
  }
  try {
    made_of["eval"] = system_.system.resolve_evaluation(options, place.Describe());
  } catch (const UsageError&) {
    return nullptr;  // An option that exists no longer.
  }
  for (const auto& [key, value] : runs.items()) made_of["eval"][key] = value;
  return made_of;
}

RowState AblationRuns::State(const Place& place) const {
  const AblationRowOptions& row = place.row.options;
  if (!row.from.empty()) return State(PlaceOf(place, row.from));
  if (place.row.trains()) {
    const fs::path run = Folder(place) / "run";
    if (!fs::exists(run / "manifest.json")) return fs::exists(run) ? RowState::kToGoOn : RowState::kToTrain;
    if (!Finished(run, Config(place))) return RowState::kToGoOn;
    if (!ablation_.options.evaluate) return RowState::kDone;
  }
  for (const std::string& name : NeededRows(place.row, system_.system.run_options)) {
    if (name == place.row.name()) continue;
    const RowState needed = State(PlaceOf(place, name));
    if (needed == RowState::kToTrain || needed == RowState::kToGoOn)
      return place.row.trains() ? RowState::kToEvaluate : needed;
  }
  const fs::path measured = Folder(place) / kMeasuredFile;
  if (!fs::exists(measured) || !fs::exists(Folder(place) / "report" / "metrics.json")) return RowState::kToEvaluate;
  return RecordedMadeOf(ReadJson(measured), place) == MadeOf(place) ? RowState::kDone : RowState::kToEvaluate;
}

void AblationRuns::Train(const Place& place, FolderCache& databases, const Task& task) const {
  if (!place.row.trains()) return;
  const fs::path run = Folder(place) / "run";
  const Json config = Config(place);
  if (fs::exists(run / "manifest.json") && Finished(run, config)) return;
  const bool begun = fs::exists(run / "resolved.toml") || fs::exists(run / "manifest.json");
  system_.training.train(config, {.directory = run, .resume = begun, .device = system_.device}, databases, task);
}

void AblationRuns::Evaluate(const Place& place, FolderCache& databases, const Task& task) const {
  if (!ablation_.options.evaluate || !place.row.evaluates() || State(place) == RowState::kDone) return;
  log::Info("Evaluating {}", place.Describe());
  const fs::path run = Run(place), report = Folder(place) / "report";
  const reports::Evaluation evaluation = system_.training.evaluate(run, Eval(place), databases, task);
  if (!fs::exists(report / "manifest.json")) fs::remove_all(report);  // Of an earlier version that was killed.
  reports::WriteEvaluation(report, evaluation);
  const Json measured = {{"format_version", 1},
                         {"made_of", MadeOf(place)},
                         {"infer_ms", system_.training.infer_ms(run)},
                         {"infer_threads", at::get_num_threads()}};
  WriteFileAtomically(Folder(place) / kMeasuredFile, measured.dump(2) + "\n");
}

AblationRuns::Place AblationRuns::Reported(const Place& place) const {
  return place.row.evaluates() ? place : PlaceOf(place, place.row.options.from);
}

Json AblationRuns::Metrics(const Place& place) const {
  return reports::ReadMetrics(Folder(Reported(place)) / "report");
}

reports::MetricTable AblationRuns::Table(const Place& place) const {
  return system_.system.read_metrics(Metrics(place));
}

std::optional<reports::Predictions> AblationRuns::Predictions(const Place& place) const {
  return reports::ReadReportPredictions(Folder(Reported(place)) / "report");
}

RunCost AblationRuns::Cost(const Place& place) const {
  const fs::path run = Run(place);
  const Manifest manifest = ReadManifest(run, "run");
  try {
    RunCost cost{.steps = manifest.counts.at("steps").get<int64_t>(),
                 .parameters = manifest.counts.at("parameters").get<int64_t>(),
                 .train_seconds = TrainSeconds(run)};
    if (!ablation_.options.evaluate) return cost;
    const Json measured = ReadJson(Folder(Reported(place)) / kMeasuredFile);
    cost.inference = RunCost::Inference{measured.at("infer_ms").get<double>(), measured.at("infer_threads").get<int>()};
    return cost;
  } catch (const Json::exception& error) {
    throw Error(fmt::format("{} or its {} is malformed: {}", run.string(), kMeasuredFile, error.what()));
  }
}

AblationMeasure AblationRuns::Validation(const Place& place) const {
  const std::string metric(system_.training.validation_metric);
  const RunCurve curve = ReadCurve(Run(place), "validation", metric);
  DAUMIER_CHECK(!curve.errors.empty(), "{} has no '{}' of validation faces", Run(place).string(), metric);
  AblationMeasure measure{.error = *std::min_element(curve.errors.begin(), curve.errors.end()), .of_run = true};
  measure.more = {{"measured_on", "validation"}};
  return measure;
}

AblationResult AblationRuns::Result(const Place& place) const {
  const AblationRowOptions& row = place.row.options;
  AblationResult result{.name = row.name, .split = place.split, .seed = place.seed, .paper = row.paper};
  try {
    if (ablation_.options.evaluate) {
      const reports::MetricTable table = Table(place);
      result.measure = MeasureOf(table, reports::FindRow(table, row.line, row.input));
    } else {
      result.measure = Validation(place);
    }
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", place.Describe(), error.what()));
  }
  if (result.measure.of_run) result.cost = Cost(place);
  return result;
}

std::vector<AblationResult> AblationRuns::Baselines(const Place& place) const {
  if (!ablation_.options.evaluate) return {};
  const reports::MetricTable table = Table(place);
  std::vector<AblationResult> results;
  for (const reports::MetricRow& row : table.rows) {
    if (!row.baseline) continue;
    results.push_back({.name = row.name,
                       .split = place.split,
                       .seed = place.seed,
                       .baseline = true,
                       .measure = MeasureOf(table, row)});
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
