#include "systems/deform/train/ablation.h"

#include "core/error.h"
#include "core/options.h"
#include "reports/chosen_faces.h"
#include "systems/deform/train/comparison.h"
#include "systems/deform/train/evaluation.h"
#include "systems/deform/train/measurement.h"
#include "systems/deform/train/run.h"
#include "systems/deform/train/surface_decoder.h"
#include "systems/deform/options.h"
#include "systems/deform/train/training.h"
#include "train/run_folder.h"


#include <algorithm>

namespace daumier::deform {
namespace {

namespace fs = std::filesystem;

/// The line of that name, or the first, which is the network's.
const Json& FindLine(const Json& metrics, const std::string& name) {
  const Json& table = metrics.at("table");
  if (name.empty()) return table.at(0);
  const auto found =
      std::find_if(table.begin(), table.end(), [&](const Json& entry) { return entry.at("name") == name; });
  DAUMIER_CHECK(found != table.end(), "a report has no line '{}'", name);
  return *found;
}

}  // namespace

Json DeformAblation::ResolvedConfig(Json config, uint64_t seed, const std::string& split,
                                    const std::string& where) const {
  config.merge_patch({{"seed", seed}, {"split", {{"kind", split}}}});
  return ToJson(ParseTraining<DeformTrainingOptions>(config, where));
}

Json DeformAblation::ResolvedEval(const Json& eval, const std::string& where) const {
  return ToJson(ParseOptions<DeformEvalOptions>(eval, where));
}

void DeformAblation::TrainRun(const Json& config, const fs::path& run, bool resume, const std::string& device) const {
  TrainDeform(config, {run, resume, ParseDevice(device)}, {});
}

void DeformAblation::Evaluate(const fs::path& run, const Json& eval, const fs::path& report) const {
  EvaluateDeformRun(run, report, ParseOptions<DeformEvalOptions>(eval));
}

double DeformAblation::InferMs(const fs::path& run) const {
  const DeformRun loaded = LoadDeformRun(run);
  return MedianMs([&] { SurfaceDecoder(loaded.network, loaded.codes[0]).Vertices(); });
}

std::vector<std::string> DeformAblation::baselines() const {
  return DeformBaselineNames();
}

ablation::AblationMeasure DeformAblation::Measure(const Json& metrics, const std::string& line, const std::string&) const {
  try {
    const Json& row = FindLine(metrics, line);
    const double mm = metrics.at("mean_vertex_error_mm").get<double>() / metrics.at("mean_vertex_error").get<double>();
    const auto in_mm = [&](const char* key) { return mm * row.at(key).get<double>(); };
    ablation::AblationMeasure measure{.error = in_mm("error"),
                            .interval = eval::Interval{in_mm("error_low"), in_mm("error_high")}};
    measure.of_run = line.empty() || line == metrics.at("table").at(0).at("name");
    measure.more = {{"model_units", row.at("error")},
                    {"percent_of_head_height", row.at("percent_of_head_height")},
                    {"p95", in_mm("p95")},
                    {"surface_sample_error_mm", in_mm("surface_sample_error")},
                    {"normal_error_degrees", row.at("normal_error_degrees")},
                    {"flipped_triangles", row.at("flipped_triangles")},
                    {"self_intersections", row.at("self_intersections")},
                    {"seconds_a_face", row.at("seconds")},
                    {"num_faces", row.at("num_faces")},
                    {"data_hash", metrics.at("data_hash")}};
    // A line of some of the faces alone is compared with no other.
    if (row.at("num_faces") == metrics.at("num_faces")) {
      DAUMIER_CHECK(
          row.contains("face_errors"),
          "its report comes from an earlier version, without the errors of each face: delete it, and the same "
          "command makes it anew");
      for (const Json& error : row.at("face_errors")) measure.face_errors.push_back(mm * error.get<double>());
      measure.groups = metrics.at("groups").get<std::vector<int>>();
    }
    return measure;
  } catch (const Json::exception& error) {
    throw Error(fmt::format("the metrics of a deformable model's run are malformed: {}", error.what()));
  }
}

void DeformAblation::WriteSheet(const std::vector<ablation::AblationPicture>& rows, const fs::path& file) const {
  const Json& metrics = rows.front().metrics;
  std::vector<ComparedDeformRun> runs;
  runs.reserve(rows.size());
  for (const ablation::AblationPicture& row : rows)
    runs.push_back({row.name, row.run, ParseOptions<DeformEvalOptions>(row.eval)});
  render::WriteImage(
      file, DeformComparison(runs, reports::ChooseFaces(metrics.at("faces").get<std::vector<int>>(),
                                                           metrics.at("face_errors").get<std::vector<double>>())));
}

}  // namespace daumier::deform
