#include "datasets/build/faces.h"

#include "core/error.h"
#include "datasets/build/faces_plan.h"
#include "datasets/build/given_faces.h"
#include "datasets/build/identity_sliders.h"
#include "datasets/build/interpolation.h"
#include "datasets/build/person_faces.h"
#include "faces/face_database.h"

#include <algorithm>
#include <variant>

namespace daumier::datasets {
namespace {

std::vector<faces::Expression> ChosenExpressions(const faces::FaceModel& model, const std::vector<std::string>& names) {
  std::vector<std::string> available;
  for (const faces::Expression& expression : model.expressions) available.push_back(expression.name);
  std::vector<faces::Expression> chosen;
  for (const int e : ChooseExpressions(available, names, model.face_template.source))
    chosen.push_back(model.expressions[e]);
  return chosen;
}

/// Adds shards of interpolated faces, as large as a person's, behind those of the persons.
void PlanInterpolation(const FacesOptions& options, const std::filesystem::path& directory, ShardedBuild& build) {
  const std::vector<Family> families = MakeFamilies(options.num_persons, options.family_size);
  std::vector<std::string> groups;
  for (size_t f = 0; f < families.size(); ++f)
    groups.insert(groups.end(), families[f].size, fmt::format("family {}", f));
  const int per_shard = build.units_per_shard;
  build.manifest.counts["interpolated"] = options.num_interpolated;
  build.manifest.details["groups"] = groups;
  build.num_units = int64_t(options.num_persons) * per_shard + options.num_interpolated;
  build.num_independent = options.num_persons;
  build.num_shards = options.num_persons + (options.num_interpolated + per_shard - 1) / per_shard;
  build.shard_name = [num_persons = options.num_persons](int shard) {
    return faces::FaceShardName(num_persons, shard);
  };
  const int num_levels = build.manifest.counts.at("levels"), num_expressions = build.manifest.counts.at("expressions");
  build.write_shard = [=, write_person = build.write_shard](int shard, const std::filesystem::path& file) {
    if (shard < options.num_persons) return write_person(shard, file);
    const int begin = (shard - options.num_persons) * per_shard;
    std::vector<Interpolation> interpolations;
    for (int i = begin; i < std::min(begin + per_shard, options.num_interpolated); ++i)
      interpolations.push_back(DrawInterpolation(families, num_levels, num_expressions, options.seed, i));
    return WriteInterpolatedShard(file, directory, interpolations);
  };
}

}  // namespace

void BuildFaces(const faces::FaceModel& model, const FacesOptions& options, const std::filesystem::path& directory,
                const Task& task) {
  const std::vector<faces::Expression> expressions = ChosenExpressions(model, options.expressions);
  std::vector<std::string> names;
  for (const faces::Expression& expression : expressions) names.push_back(expression.name);
  ShardedBuild build = PlanFaces(model.face_template, options, options.num_persons, names);
  build.manifest.details["identity_controls"] = IdentityControlsToJson(model.identity_controls);
  const PersonFacesMaker maker(model, expressions, options);
  build.manifest.details.update(maker.Details());
  build.write_shard = [&](int person, const std::filesystem::path& file) {
    return WritePersonShard(file, build.manifest, maker.Make(person));
  };
  if (options.num_interpolated > 0) PlanInterpolation(options, directory, build);
  BuildShards(directory, build, task);
}

void BuildFaces(const FacesOptions& options, const std::filesystem::path& directory, const Task& task) {
  const auto source = faces::LoadSource(options.source);
  if (const auto* given = std::get_if<faces::GivenFaces>(&source))
    return BuildGivenFaces(*given, options, directory, task);
  BuildFaces(std::get<faces::FaceModel>(source), options, directory, task);
}

}  // namespace daumier::datasets
