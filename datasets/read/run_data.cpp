#include "datasets/read/run_data.h"

#include "core/error.h"
#include "core/log.h"
#include "core/run_manifest.h"

namespace daumier::datasets {
namespace {

namespace fs = std::filesystem;

/// The text `json.data.KIND` of a run's file.
std::string DataEntry(const Json& json, const std::string& kind, const fs::path& file) {
  const Json::json_pointer place = Json::json_pointer("/data") / kind;
  DAUMIER_CHECK(json.contains(place) && json.at(place).is_string(),
                "{} has no data.{} (expected a text): the run is of another task, or damaged. Train again",
                file.string(), kind);
  return json.at(place).get<std::string>();
}

bool IsThere(const fs::path& folder) {
  return fs::exists(folder / "manifest.json");
}

/// The folder A / S with that data hash, where A is a folder above the run and S an end of the path `recorded`; of
/// several the one of the nearest A, and of the longest S. Empty if there is none.
fs::path FindMovedWithRun(const fs::path& run, const fs::path& recorded, const std::string& hash) {
  const fs::path relative = recorded.relative_path();
  const std::vector<fs::path> parts(relative.begin(), relative.end());
  fs::path above = fs::weakly_canonical(run);
  while (above.has_parent_path() && above != above.parent_path()) {
    above = above.parent_path();
    for (auto begin = parts.begin(); begin != parts.end(); ++begin) {
      fs::path folder = above;
      for (auto part = begin; part != parts.end(); ++part) folder /= *part;
      if (IsThere(folder) && DataHash(folder) == hash) return folder;
    }
  }
  return {};
}

}  // namespace

fs::path FindRunData(const fs::path& run, const Manifest& manifest, const Json& config, const std::string& kind,
                     const std::string& moved, const std::string& manifest_kind) {
  const std::string trained_on = DataEntry(manifest.details, kind, run / "manifest.json");
  const fs::path recorded = DataEntry(config, kind, ResolvedConfig(run));
  fs::path folder = moved.empty() ? recorded : fs::path(moved);
  if (moved.empty() && !IsThere(recorded)) {
    folder = FindMovedWithRun(run, recorded, trained_on);
    DAUMIER_CHECK(!folder.empty(),
                  "{} is absent (expected the {} that {} was trained on). If they have moved, add data.{}=FOLDER",
                  recorded.string(), kind, run.string(), kind);
    log::Info("The {} of {} have moved with it; reading {}", kind, run.string(), folder.string());
  }
  ReadManifest(folder, manifest_kind.empty() ? kind : manifest_kind);
  DAUMIER_CHECK(DataHash(folder) == trained_on,
                "{}: the {} differ from the training data of {} (data hash {}). Restore the original folder or retrain",
                folder.string(), kind, run.string(), trained_on.substr(0, 12));
  return folder;
}

Split SplitOfRun(const std::filesystem::path& run, const Manifest& manifest, const Json& config,
                 const faces::FaceDatabase& faces) {
  Split split = MakeSplit(faces, ParseOptions<SplitOptions>(config.at("split"), "split of the run"), manifest.seed);
  DAUMIER_CHECK(SplitToJson(faces, split) == manifest.details.at("split"),
                "{}: the train/validation/test split does not match the run's manifest; the run is of another version",
                run.string());
  return split;
}

Manifest ManifestOfTraining(Json config, uint64_t seed, const faces::FaceDatabase& faces, const Split& split) {
  Manifest manifest;
  manifest.kind = "run";
  manifest.verb = "train";
  manifest.config = std::move(config);
  manifest.config.erase("data");
  manifest.seed = seed;
  manifest.sources = faces.manifest().sources;
  manifest.counts = {{"training_faces", split.train.size()},
                     {"validation_faces", split.validation.size()},
                     {"test_faces", split.test.size()}};
  manifest.details["split"] = SplitToJson(faces, split);
  return manifest;
}

const std::vector<int>& SubsetOf(const Split& split, const std::string& name) {
  if (name == "train") return split.train;
  if (name == "validation") return split.validation;
  if (name == "test") return split.test;
  throw UsageError(fmt::format("unknown subset '{}' of a split, expected train, validation or test", name));
}

}  // namespace daumier::datasets
