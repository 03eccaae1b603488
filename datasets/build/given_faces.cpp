#include "datasets/build/given_faces.h"

#include "datasets/build/faces_plan.h"

namespace daumier::datasets {
namespace {

/// All faces of a person, (levels, expressions, 3V), next to each other.
std::vector<float> PersonVertices(const faces::GivenFaces& given, int person, const std::vector<int>& expressions,
                                  const faces::ExaggerationOptions& exaggeration) {
  const geometry::Points neutral = given.face(person, 0);
  const std::vector<geometry::Points> levels = FaceLevels(given.face_template, neutral, exaggeration);
  std::vector<geometry::Points> offsets;
  for (const int expression : expressions) offsets.push_back(given.face(person, expression) - neutral);
  std::vector<float> vertices;
  vertices.reserve(levels.size() * offsets.size() * neutral.size());
  for (const geometry::Points& level : levels) {
    for (const geometry::Points& offset : offsets) {
      const geometry::Points face = level + offset;
      vertices.insert(vertices.end(), face.data(), face.data() + face.size());
    }
  }
  return vertices;
}

}  // namespace

void BuildGivenFaces(const faces::GivenFaces& given, const FacesOptions& options,
                     const std::filesystem::path& directory) {
  const std::vector<int> chosen = ChooseExpressions(given.expressions, options.expressions, given.face_template.source);
  std::vector<std::string> names;
  for (const int expression : chosen) names.push_back(given.expressions[expression]);
  ShardedBuild build = PlanFaces(given.face_template, options, static_cast<int>(given.names.size()), names);
  build.manifest.config["num_persons"] = given.names.size();
  build.manifest.details["names"] = given.names;
  build.manifest.details["groups"] = given.groups;
  build.write_shard = [&](int person, const std::filesystem::path& file) {
    return WritePersonShard(file, build.manifest, PersonVertices(given, person, chosen, options.exaggeration), {});
  };
  BuildShards(directory, build);
}

}  // namespace daumier::datasets
