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

/// Names the weights of a finished run.
std::string WeightsOf(const fs::path& run) {
  return ReadManifest(run, "run").checksums.at(kBestFile);
}

Json ReadJson(const fs::path& file) {
  try {
    return Json::parse(ReadFile(file));
  } catch (const Json::exception& error) {
    throw Error(fmt::format("{} is no JSON: {}", file.string(), error.what()));
  }
}

}  // namespace

AblationRuns::AblationRuns(const Ablation& ablation, const AblationTask& task, const fs::path& directory)
    : ablation_(ablation), task_(task), directory_(directory), references_(task.references()) {
  for (const AblationRow& row : ablation.rows) {
    if (row.evaluates()) task.ResolvedEval(row.eval, fmt::format("eval of row '{}'", row.name()));
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
  return task_.ResolvedConfig(place.row.config, place.seed, place.split,
                              fmt::format("config of row '{}'", place.row.name()));
}

fs::path AblationRuns::Run(const Place& place) const {
  if (!place.row.options.run_of.empty()) return Run(PlaceOf(place, place.row.options.run_of));
  if (!place.row.options.from.empty()) return Run(PlaceOf(place, place.row.options.from));
  return Folder(place) / "run";
}

Json AblationRuns::Eval(const Place& place) const {
  Json eval = task_.ResolvedEval(place.row.eval, fmt::format("eval of row '{}'", place.row.name()));
  for (const std::string& key : references_)
    if (const std::string name = eval.value(key, ""); !name.empty()) eval[key] = Run(PlaceOf(place, name)).string();
  return eval;
}

Json AblationRuns::Made(const Place& place) const {
  Json made = {{"eval", task_.ResolvedEval(place.row.eval, place.row.name())}, {"weights", WeightsOf(Run(place))}};
  for (const std::string& key : references_)
    if (const std::string name = made["eval"].value(key, ""); !name.empty())
      made["eval"][key] = {{"row", name}, {"weights", WeightsOf(Run(PlaceOf(place, name)))}};
  return made;
}

RowState AblationRuns::State(const Place& place) const {
  const AblationRowOptions& row = place.row.options;
  if (!row.from.empty()) return State(PlaceOf(place, row.from));
  if (place.row.trains()) {
    const fs::path run = Folder(place) / "run";
    if (!fs::exists(run / "manifest.json")) return fs::exists(run) ? RowState::kToGoOn : RowState::kToTrain;
    if (!task_.Finished(run, Config(place))) return RowState::kToGoOn;
    if (!ablation_.options.evaluate) return RowState::kDone;
  }
  for (const std::string& name : NeededRows(place.row, references_)) {
    if (name == place.row.name()) continue;
    const RowState needed = State(PlaceOf(place, name));
    if (needed == RowState::kToTrain || needed == RowState::kToGoOn)
      return place.row.trains() ? RowState::kToEvaluate : needed;
  }
  const fs::path measured = Folder(place) / kMeasuredFile;
  if (!fs::exists(measured) || !fs::exists(Folder(place) / "report" / "metrics.json")) return RowState::kToEvaluate;
  return ReadJson(measured).value("made_of", Json()) == Made(place) ? RowState::kDone : RowState::kToEvaluate;
}

void AblationRuns::Train(const Place& place) const {
  if (!place.row.trains()) return;
  const fs::path run = Folder(place) / "run";
  const Json config = Config(place);
  if (fs::exists(run / "manifest.json") && task_.Finished(run, config)) return;
  task_.Train(config, run);
}

void AblationRuns::Evaluate(const Place& place) const {
  if (!ablation_.options.evaluate || !place.row.evaluates() || State(place) == RowState::kDone) return;
  log::Info("Evaluating {}", place.Describe());
  const fs::path run = Run(place);
  task_.Evaluate(run, Eval(place), Folder(place) / "report");
  const Json measured = {{"format_version", 1},
                         {"made_of", Made(place)},
                         {"infer_ms", task_.InferMs(run)},
                         {"infer_threads", at::get_num_threads()}};
  WriteFileAtomically(Folder(place) / kMeasuredFile, measured.dump(2) + "\n");
}

AblationRuns::Place AblationRuns::Reported(const Place& place) const {
  return place.row.evaluates() ? place : PlaceOf(place, place.row.options.from);
}

Json AblationRuns::Metrics(const Place& place) const {
  return ReadJson(Folder(Reported(place)) / "report" / "metrics.json");
}

RunCost AblationRuns::Cost(const Place& place) const {
  const fs::path run = Run(place);
  const Manifest manifest = ReadManifest(run, "run");
  RunCost cost{.steps = manifest.counts.at("steps").get<int64_t>(),
               .parameters = manifest.counts.at("parameters").get<int64_t>(),
               .train_seconds = TrainSeconds(run)};
  if (!ablation_.options.evaluate) return cost;
  const Json measured = ReadJson(Folder(Reported(place)) / kMeasuredFile);
  cost.inference = RunCost::Inference{measured.at("infer_ms").get<double>(), measured.at("infer_threads").get<int>()};
  return cost;
}

AblationMeasure AblationRuns::Validation(const Place& place) const {
  const std::string metric = task_.validation_metric();
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
    result.measure =
        ablation_.options.evaluate ? task_.Measure(Metrics(place), row.line, row.shape_input) : Validation(place);
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", place.Describe(), error.what()));
  }
  if (result.measure.of_run) result.cost = Cost(place);
  return result;
}

std::vector<AblationResult> AblationRuns::Baselines(const Place& place) const {
  if (!ablation_.options.evaluate) return {};
  const Json metrics = Metrics(place);
  std::vector<AblationResult> results;
  for (const std::string& line : task_.baselines()) {
    if (!task_.HasLine(metrics, line)) continue;
    results.push_back({.name = line,
                       .split = place.split,
                       .seed = place.seed,
                       .baseline = true,
                       .measure = task_.Measure(metrics, line, "")});
  }
  return results;
}

AblationPicture AblationRuns::Picture(const Place& place) const {
  return {place.row.name(), place.row.options.shape_input, Run(place), Eval(Reported(place)), Metrics(place)};
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
