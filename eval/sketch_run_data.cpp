#include "eval/sketch_run_data.h"

#include "core/error.h"
#include "core/manifest.h"

namespace daumier::eval {
namespace {

void CheckSameData(const models::SketchRun& run, const std::string& kind) {
  const std::string folder = run.config.at("data").at(kind).get<std::string>();
  const std::string trained_on = run.manifest.details.at("data").at(kind).get<std::string>();
  DAUMIER_CHECK(DataHash(folder) == trained_on,
                "{} holds other {} than {} was trained on (data hash {}): give it that data back, or train again",
                folder, kind, run.directory.string(), trained_on.substr(0, 12));
}

}  // namespace

const std::vector<int>& SketchRunData::side(const std::string& name) const {
  if (name == "train") return split.train;
  if (name == "validation") return split.validation;
  if (name == "test") return split.test;
  throw UsageError(fmt::format("'{}' is no side of a split: train, validation or test", name));
}

SketchRunData OpenSketchRunData(const std::filesystem::path& run_directory) {
  models::SketchRun run = models::LoadSketchRun(run_directory);
  try {
    CheckSameData(run, "faces");
    CheckSameData(run, "sketches");
    faces::FaceDatabase faces(run.config.at("data").at("faces").get<std::string>());
    datasets::SketchDatabase sketches(run.config.at("data").at("sketches").get<std::string>());
    datasets::Split split = datasets::MakeSplit(
        faces, ParseOptions<datasets::SplitOptions>(run.config.at("split"), "split of the run"), run.manifest.seed);
    DAUMIER_CHECK(datasets::SplitToJson(faces, split) == run.manifest.details.at("split"),
                  "{} was split otherwise when it was trained: it comes from another version of this program",
                  run_directory.string());
    const auto sketch = ParseOptions<datasets::SketchVariation>(run.config.at("sketch"), "sketches of the run");
    return {std::move(run), std::move(faces), std::move(sketches), std::move(split), sketch};
  } catch (const Json::exception& error) {
    throw Error(fmt::format("{} is not the folder of a sketch run: {}", run_directory.string(), error.what()));
  }
}

}  // namespace daumier::eval
