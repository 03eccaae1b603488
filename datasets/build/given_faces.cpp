#include "datasets/build/given_faces.h"

#include "core/error.h"
#include "datasets/build/face_levels.h"
#include "datasets/build/faces_plan.h"

#include <algorithm>

namespace daumier::datasets {
namespace {

PersonArrays MakePerson(const faces::GivenFaces& given, const LevelMaker& levels, int person,
                        const std::vector<int>& expressions) {
  const geometry::Points neutral = given.face(person, 0);
  std::vector<geometry::Points> offsets;
  for (const int expression : expressions) offsets.push_back(given.face(person, expression) - neutral);
  PersonArrays arrays;
  for (const geometry::Points& level : levels.Make(neutral, person, arrays)) {
    for (const geometry::Points& offset : offsets) {
      const geometry::Points face = level + offset;
      arrays.vertices.insert(arrays.vertices.end(), face.data(), face.data() + face.size());
    }
  }
  return arrays;
}

}  // namespace

void BuildGivenFaces(const faces::GivenFaces& given, const FacesOptions& options,
                     const std::filesystem::path& directory, const Task& task) {
  if (options.num_interpolated > 0) {
    throw UsageError(fmt::format("faces of source {} are used unmodified; num_interpolated has to be 0",
                                 given.face_template.source));
  }
  const std::vector<int> chosen = ChooseExpressions(given.expressions, options.expressions, given.face_template.source);
  std::vector<std::string> names;
  for (const int expression : chosen) names.push_back(given.expressions[expression]);
  ShardedBuild build = PlanFaces(given.face_template, options, static_cast<int>(given.names.size()), names);
  build.manifest.config["num_persons"] = given.names.size();
  build.manifest.details["names"] = given.names;
  build.manifest.details["groups"] = given.groups;
  constexpr int kMaxPopulation = 200;
  const LevelMaker levels(given.face_template, options,
                          {std::min(kMaxPopulation, static_cast<int>(given.names.size())),
                           [&](int person) { return given.face(person, 0); }});
  build.manifest.details.update(levels.Details());
  build.write_shard = [&](int person, const std::filesystem::path& file) {
    return WritePersonShard(file, build.manifest, MakePerson(given, levels, person, chosen));
  };
  BuildShards(directory, build, task);
}

}  // namespace daumier::datasets
