#include "systems/sketch/train/run_data.h"

#include "core/error.h"
#include "datasets/read/run_data.h"

namespace daumier::sketch {

const std::vector<int>& SketchRunData::side(const std::string& name) const {
  return datasets::SubsetOf(split, name);
}

SketchRunData OpenSketchRunData(const std::filesystem::path& run_directory) {
  FolderCache databases;
  return OpenSketchRunData(run_directory, databases);
}

SketchRunData OpenSketchRunData(const std::filesystem::path& run_directory, FolderCache& databases,
                                const SketchEvalData& moved) {
  SketchRun run = LoadSketchRun(run_directory);
  try {
    const auto folder = [&](const char* kind, const std::string& moved_to) {
      return datasets::FindRunData(run_directory, run.manifest, run.config, kind, moved_to);
    };
    const std::filesystem::path faces_folder = folder("faces", moved.faces),
                                sketches_folder = folder("sketches", moved.sketches);
    // Copies share the mapped shards.
    const auto& faces = databases.Open<faces::FaceDatabase>(faces_folder);
    const auto& sketches = databases.Open<datasets::SketchDatabase>(sketches_folder);
    datasets::Split split = datasets::SplitOfRun(run_directory, run.manifest, run.config, faces);
    const auto sketch = ParseOptions<datasets::SketchVariation>(run.config.at("sketch"), "sketches of the run");
    return {std::move(run), faces, sketches, std::move(split), sketch};
  } catch (const Json::exception& error) {
    throw Error(fmt::format("{} is not the folder of a sketch run: {}", run_directory.string(), TextOf(error)));
  }
}

}  // namespace daumier::sketch
