#include "eval/run_data.h"

#include "core/error.h"

namespace daumier::eval {

void CheckSameData(const std::filesystem::path& run, const Manifest& manifest, const Json& config,
                   const std::string& kind) {
  const std::string folder = config.at("data").at(kind).get<std::string>();
  const std::string trained_on = manifest.details.at("data").at(kind).get<std::string>();
  DAUMIER_CHECK(DataHash(folder) == trained_on,
                "{} holds other {} than {} was trained on (data hash {}): give it that data back, or train again",
                folder, kind, run.string(), trained_on.substr(0, 12));
}

datasets::Split SplitOfRun(const std::filesystem::path& run, const Manifest& manifest, const Json& config,
                           const faces::FaceDatabase& faces) {
  datasets::Split split = datasets::MakeSplit(
      faces, ParseOptions<datasets::SplitOptions>(config.at("split"), "split of the run"), manifest.seed);
  DAUMIER_CHECK(datasets::SplitToJson(faces, split) == manifest.details.at("split"),
                "{} was split otherwise when it was trained: it comes from another version of this program",
                run.string());
  return split;
}

const std::vector<int>& SideOf(const datasets::Split& split, const std::string& name) {
  if (name == "train") return split.train;
  if (name == "validation") return split.validation;
  if (name == "test") return split.test;
  throw UsageError(fmt::format("'{}' is no side of a split: train, validation or test", name));
}

}  // namespace daumier::eval
