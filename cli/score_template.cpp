#include "cli/score_template.h"

#include "core/error.h"
#include "core/json.h"
#include "core/log.h"
#include "core/manifest.h"
#include "core/weights_folder.h"
#include "datasets/build/sketch_views.h"
#include "faces/face_database.h"
#include "render/camera_json.h"
#include "render/framing.h"
#include "systems/shipped_weights.h"

namespace daumier::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kNameOne = "Name a run, weights or a folder of faces: --template FOLDER";

/// `details` of a folder's manifest; an empty object where there are none.
Json DetailsOf(const fs::path& folder) {
  const fs::path file = folder / "manifest.json";
  if (!fs::exists(file)) return Json::object();
  const Json manifest = ReadJson(file);
  const Json details = manifest.is_object() ? manifest.value("details", Json()) : Json();
  return details.is_object() ? details : Json::object();
}

fs::path ShippedFolder(const std::string& name) {
  const std::vector<fs::path> places = systems::WeightsPlaces();
  return systems::WeightsNamed(name, systems::ListWeights(places), places);
}

/// The folder that `named` or the predictions name.
fs::path NamedFolder(const std::string& named, const Json& of_predictions, const fs::path& predictions) {
  if (named.empty()) {
    if (!of_predictions.contains("weights"))
      throw UsageError(
          fmt::format("{} does not name the weights of its predictions, so that their template is "
                      "unknown. {}",
                      (predictions / "manifest.json").string(), kNameOne));
    return ShippedFolder(of_predictions.at("weights").get<std::string>());
  }
  std::error_code ignored;
  return fs::is_directory(named, ignored) ? fs::path(named) : ShippedFolder(named);
}

/// The folder with the template: this one, or weights that it needs.
fs::path TemplateFolder(const fs::path& folder) {
  const auto has_template = [](const fs::path& place) { return fs::exists(place / "template.json"); };
  if (has_template(folder)) return folder;
  if (IsWeightsFolder(folder)) {
    const Manifest manifest = ReadManifest(folder, kWeightsKind);
    const Json needs = manifest.details.value("needs", Json::object());
    for (const auto& [name, hash] : needs.items())
      if (has_template(WeightsNextTo(folder, name))) return NeededWeights(folder, manifest, name);
  }
  throw UsageError(fmt::format("{} has no template (no template.json). {}", folder.string(), kNameOne));
}

}  // namespace

ScoreTemplate ReadScoreTemplate(const std::string& named, const fs::path& predictions) {
  const Json of_predictions = DetailsOf(predictions);
  const fs::path folder = NamedFolder(named, of_predictions, predictions);
  ScoreTemplate result;
  result.face_template = faces::ReadFaceTemplate(TemplateFolder(folder));
  const Json details = DetailsOf(folder);
  const Json sketches = details.value("sketches", Json());
  if (sketches.is_object() && sketches.contains("camera")) {
    result.camera = render::CameraFromJson(sketches.at("camera"));
    const Json hash = of_predictions.value("run_data_hash", Json());
    if (hash.is_string() && hash != DataHash(folder))
      log::Warn("{} was predicted by another run than {}", predictions.string(), folder.string());
  } else {
    result.camera =
        datasets::SketchCamera(result.face_template, faces::View::kFrontal, render::FrameOptions{}.curve_height);
  }
  return result;
}

}  // namespace daumier::cli
