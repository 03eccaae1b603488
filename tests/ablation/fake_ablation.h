#pragma once
#include "core/error.h"
#include "core/files.h"
#include "core/interrupt.h"
#include "core/manifest.h"
#include "core/options.h"
#include "ablation/task.h"

#include <algorithm>
#include <map>

namespace daumier::ablation {

/// An ablation whose runs learn nothing: the error that a run will have stands in its config. Tells what was done.
class FakeAblation : public AblationTask {
 public:
  struct Config {
    double error = 1;
    std::string end = "well";
    uint64_t seed = 0;
    std::string split;

    template <class V>
    void Visit(V&& visit) {
      visit("error", error, Range{0, 100}, "Of the run.");
      visit("end", end, Choices{{"well", "failed", "stopped"}}, "How a training ends.");
      visit("seed", seed, Range{0, 100}, "Seed.");
      visit("split", split, Text{}, "Split.");
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

  mutable std::vector<std::string> log;  ///< "train 2", "evaluate 2": with the error of the run.
  mutable int num_sheets = 0;
  int num_faces = 4;
  std::map<double, std::string> end_of_error;  ///< How the next training of that error ends, in place of its config.

  Json ResolvedConfig(Json config, uint64_t seed, const std::string& split, const std::string& where) const override {
    config["seed"] = seed;
    config["split"] = split;
    return ToJson(ParseOptions<Config>(config, where));
  }
  Json ResolvedEval(const Json& eval, const std::string& where) const override {
    return ToJson(ParseOptions<Eval>(eval, where));
  }
  std::vector<std::string> references() const override { return {"recover_with"}; }

  bool Finished(const std::filesystem::path& run, const Json& config) const override {
    const Manifest manifest = ReadManifest(run, "run");
    if (manifest.config != config) throw UsageError(fmt::format("{} is another run", run.string()));
    return manifest.counts.contains("best_epoch");
  }

  void Train(const Json& config, const std::filesystem::path& run) const override {
    const auto options = ParseOptions<Config>(config);
    log.push_back(fmt::format("train {}", options.error));
    const auto found = end_of_error.find(options.error);
    const std::string end = found == end_of_error.end() ? options.end : found->second;
    MakeDirectory(run);
    Manifest manifest;
    manifest.kind = "run";
    manifest.verb = "train";
    manifest.config = config;
    if (end == "well") {
      manifest.counts = {{"steps", 10}, {"parameters", 7}, {"best_epoch", 1}};
      manifest.checksums = {{"best/model.safetensors", fmt::format("weights {}", config.dump())}};
    }
    WriteManifest(run, manifest);
    WriteFileAtomically(run / "metrics.jsonl", Lines(options.error));
    if (end == "failed") throw Error("the loss is not a number");
    if (end == "stopped") {
      SetInterrupted(true);
      throw Error("go on with: daumier train --resume");
    }
  }

  void Evaluate(const std::filesystem::path& run, const Json& eval,
                const std::filesystem::path& report) const override {
    const auto options = ParseOptions<Eval>(eval);
    const auto config = ParseOptions<Config>(ReadManifest(run, "run").config);
    log.push_back(fmt::format("evaluate {}", config.error));
    if (!options.recover_with.empty()) ReadManifest(options.recover_with, "run");
    const double error = options.factor * config.error + 0.01 * double(config.seed);
    Json metrics = {{"errors", {{"network", error}, {"fit", 5.0}, {"mean face", 9.0}}}, {"num_faces", num_faces}};
    MakeDirectory(report);
    WriteFileAtomically(report / "metrics.json", metrics.dump());
  }

  double InferMs(const std::filesystem::path&) const override { return 2.5; }
  std::string unit() const override { return "mm"; }
  std::string validation_metric() const override { return "error"; }
  std::vector<std::string> baselines() const override { return {"mean face"}; }

  bool HasLine(const Json& metrics, const std::string& line) const override {
    return metrics.at("errors").contains(line);
  }

  /// Faces of two persons, whose errors lie 0.1 below and above the mean.
  AblationMeasure Measure(const Json& metrics, const std::string& line, const std::string&) const override {
    const std::string name = line.empty() ? "network" : line;
    DAUMIER_CHECK(metrics.at("errors").contains(name), "there is no line '{}'", name);
    AblationMeasure measure;
    measure.error = metrics["errors"][name].get<double>();
    measure.interval = eval::Interval{measure.error - 0.1, measure.error + 0.1};
    measure.more = {{"p90", measure.error + 1}, {"shape_input", "none"}};
    measure.of_run = name == "network";
    if (!measure.of_run) return measure;
    measure.face_errors = {measure.error - 0.1, measure.error + 0.1};
    measure.groups = {0, 1};
    return measure;
  }
  std::string TestedOn(const Json& metrics) const override { return metrics.at("num_faces").dump(); }

  void WriteSheet(const std::vector<AblationPicture>& rows, const std::filesystem::path& file) const override {
    ++num_sheets;
    std::string text;
    for (const AblationPicture& row : rows) text += row.name + "\n";
    WriteFileAtomically(file, text);
  }

 private:
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
};

}  // namespace daumier::ablation
