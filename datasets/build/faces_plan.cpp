#include "datasets/build/faces_plan.h"

#include "core/error.h"
#include "core/safetensors.h"
#include "faces/face_database.h"

#include <algorithm>
#include <set>

namespace daumier::datasets {

std::vector<int> ChooseExpressions(const std::vector<std::string>& available, const std::vector<std::string>& wanted,
                                   const std::string& source) {
  std::vector<int> chosen;
  std::set<std::string> taken;
  for (const std::string& name : wanted.empty() ? available : wanted) {
    const auto found = std::find(available.begin(), available.end(), name);
    if (found == available.end()) {
      const std::set<std::string> known(available.begin(), available.end());
      const std::string near = NearestWord(name, known);
      throw UsageError(fmt::format(
          "source {} has no expression '{}'; {}", source, name,
          near.empty() ? fmt::format("it has: {}", fmt::join(known, ", ")) : fmt::format("did you mean '{}'?", near)));
    }
    if (!taken.insert(name).second) throw UsageError(fmt::format("expression '{}' is named twice", name));
    chosen.push_back(static_cast<int>(found - available.begin()));
  }
  if (chosen.empty() || available[chosen.front()] != "neutral")
    throw UsageError("the first of expressions has to be neutral");
  return chosen;
}

const std::vector<double>& LevelStrengths(const FacesOptions& options) {
  return options.levels == "controls" ? options.caricature.amounts : options.exaggeration.gammas;
}

ShardedBuild PlanFaces(const faces::FaceTemplate& face_template, const FacesOptions& options, int num_persons,
                       const std::vector<std::string>& expressions) {
  const std::vector<double>& gammas = LevelStrengths(options);
  if (!options.own_controls.empty() && options.levels != "controls")
    throw UsageError("own_controls need levels = \"controls\"");
  if (gammas.empty() || gammas.front() != 0.0) {
    throw UsageError(fmt::format("the first of {} has to be 0",
                                 options.levels == "controls" ? "caricature.amounts" : "exaggeration.gammas"));
  }
  if (gammas.size() > 1) {
    for (const char* region : {"eyes", "mouth", "neck_border", "nose", "ears"})
      faces::RegionFor(face_template.annotation, region, "exaggeration (every level but the first)");
  }
  ShardedBuild build;
  build.manifest.kind = "faces";
  build.manifest.verb = "dataset faces";
  build.manifest.config = ToJson(options);
  for (const char* path : {"path", "annotation", "template_mesh"}) build.manifest.config["source"].erase(path);
  build.manifest.config.erase("own_controls");  // Files; their content is in details.own_controls.
  build.manifest.seed = options.seed;
  build.manifest.sources = Json::array({face_template.provenance});
  build.units_per_shard = static_cast<int>(gammas.size() * expressions.size());
  build.manifest.counts = {{"persons", num_persons},
                           {"levels", gammas.size()},
                           {"expressions", expressions.size()},
                           {"faces", int64_t(num_persons) * build.units_per_shard},
                           {"vertices", face_template.num_vertices()}};
  build.manifest.details = {{"source", face_template.source}, {"gammas", gammas}, {"expressions", expressions}};
  build.num_shards = num_persons;
  build.unit = "faces";
  build.shard_name = faces::PersonShardName;
  build.write_rest = [&face_template](const std::filesystem::path& folder) {
    return faces::WriteFaceTemplate(folder, face_template);
  };
  return build;
}

std::string WritePersonShard(const std::filesystem::path& file, const Manifest& manifest, const PersonArrays& arrays) {
  const auto count = [&](const char* name) { return manifest.counts.at(name).get<int64_t>(); };
  SafetensorsWriter writer;
  writer.SetMetadata("kind", "faces");
  const auto add = [&](const std::string& name, std::vector<int64_t> shape, const std::vector<float>& values) {
    if (!values.empty()) writer.Add<float>(name, std::move(shape), values);
  };
  add("vertices", {count("levels"), count("expressions"), count("vertices"), 3}, arrays.vertices);
  add("identity_weights", {static_cast<int64_t>(arrays.identity_weights.size())}, arrays.identity_weights);
  add("expression_strengths", {count("expressions")}, arrays.expression_strengths);
  const auto add_rows = [&](const std::string& name, int64_t row_size, const std::vector<float>& values) {
    add(name, {count("levels"), static_cast<int64_t>(values.size()) / row_size / count("levels"), row_size}, values);
  };
  add_rows("part_strengths", 4, arrays.part_strengths);
  if (!arrays.control_values.empty())
    add("control_values", {count("levels"), static_cast<int64_t>(arrays.control_values.size()) / count("levels")},
        arrays.control_values);
  add_rows("lumps", 5, arrays.bumps);
  return writer.Write(file);
}

}  // namespace daumier::datasets
