#include "datasets/read/run_data.h"

#include "core/error.h"

namespace daumier::datasets {

void CheckSameData(const std::filesystem::path& run, const Manifest& manifest, const Json& config,
                   const std::string& kind) {
  const std::string folder = config.at("data").at(kind).get<std::string>();
  const std::string trained_on = manifest.details.at("data").at(kind).get<std::string>();
  DAUMIER_CHECK(DataHash(folder) == trained_on,
                "{}: the {} differ from the training data of {} (data hash {}). Restore the original folder or retrain",
                folder, kind, run.string(), trained_on.substr(0, 12));
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
