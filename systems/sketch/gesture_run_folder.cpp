#include "systems/sketch/gesture_run_folder.h"

#include "core/error.h"
#include "core/run_manifest.h"
#include "core/weights_folder.h"

namespace daumier::sketch {

Json RejectionToJson(const GestureRejection& rejection) {
  return {{"threshold", rejection.threshold}, {"accepted", rejection.accepted}};
}

GestureRejection RejectionFromJson(const Json& json, const std::string& where) {
  const auto number = [&](const char* key) {
    const double value = json.is_object() && json.contains(key) && json[key].is_number() ? json[key].get<double>() : -1;
    DAUMIER_CHECK(value >= 0 && value <= 1,
                  "{}: details.rejection is {} (expected threshold and accepted, each 0 to 1). Train again: daumier "
                  "train",
                  where, json.dump());
    return value;
  };
  return {.threshold = number("threshold"), .accepted = number("accepted")};
}

GestureRunFolder ReadGestureRunFolder(const std::filesystem::path& directory) {
  GestureRunFolder run;
  run.directory = directory;
  run.manifest = ReadFinishedRun(directory, kGestureSystem);
  run.config = ReadRunConfig(directory, run.manifest);
  const std::string file = ResolvedConfig(directory).string();
  DAUMIER_CHECK(run.config.contains("network"),
                "{} has no table 'network': it is not the config of a run that classifies gestures", file);
  run.network_options = ParseOptions<GestureNetworkOptions>(run.config["network"], file);
  return run;
}

GestureDecision ReadGestureDecision(const std::filesystem::path& run_or_weights) {
  const std::string file = (run_or_weights / "manifest.json").string();
  if (!IsWeightsFolder(run_or_weights)) {
    const GestureRunFolder run = ReadGestureRunFolder(run_or_weights);
    return {run.network_options, RejectionFromJson(run.manifest.details.value("rejection", Json()), file)};
  }
  const Manifest manifest = ReadWeights(run_or_weights, kGestureSystem, {kWeightsNetwork});
  return {ParseOptions<GestureNetworkOptions>(manifest.details.value("network", Json::object()), file),
          RejectionFromJson(manifest.details.value("rejection", Json()), file)};
}

}  // namespace daumier::sketch
