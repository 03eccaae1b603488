#include "datasets/build/faces.h"

#include "datasets/build/faces_plan.h"
#include "datasets/build/given_faces.h"

#include <variant>

namespace daumier::datasets {
namespace {

/// All faces of a person, (levels, expressions, 3V), next to each other.
std::vector<float> PersonVertices(const faces::FaceModel& model, const Eigen::VectorXf& identity,
                                  const Eigen::MatrixXf& offsets, const faces::ExaggerationOptions& exaggeration) {
  const geometry::Points neutral = faces::IdentityFace(model, identity);
  std::vector<float> vertices;
  vertices.reserve(exaggeration.gammas.size() * offsets.size());
  for (const geometry::Points& level : FaceLevels(model.face_template, neutral, exaggeration)) {
    const Eigen::VectorXf base = Eigen::Map<const Eigen::VectorXd>(level.data(), level.size()).cast<float>();
    for (Eigen::Index e = 0; e < offsets.cols(); ++e) {
      const Eigen::VectorXf face = base + offsets.col(e);
      vertices.insert(vertices.end(), face.begin(), face.end());
    }
  }
  return vertices;
}

}  // namespace

void BuildFaces(const faces::FaceModel& model, const FacesOptions& options, const std::filesystem::path& directory) {
  std::vector<std::string> available, names;
  for (const faces::Expression& expression : model.expressions) available.push_back(expression.name);
  const std::vector<int> chosen = ChooseExpressions(available, options.expressions, model.face_template.source);
  Eigen::MatrixXf offsets(model.face_template.neutral.size(), chosen.size());
  for (size_t e = 0; e < chosen.size(); ++e) {
    names.push_back(available[chosen[e]]);
    offsets.col(Eigen::Index(e)) = faces::ExpressionOffset(model, model.expressions[chosen[e]].weights);
  }
  ShardedBuild build = PlanFaces(model.face_template, options, options.num_persons, names);
  build.write_shard = [&](int person, const std::filesystem::path& file) {
    Rng rng = Stream(options.seed, "identity", person);
    const Eigen::VectorXf identity = faces::DrawIdentity(model, rng, options.identity_spread);
    return WritePersonShard(file, build.manifest, PersonVertices(model, identity, offsets, options.exaggeration),
                            {identity.data(), static_cast<size_t>(identity.size())});
  };
  BuildShards(directory, build);
}

void BuildFaces(const FacesOptions& options, const std::filesystem::path& directory) {
  const auto source = faces::LoadSource(options.source);
  if (const auto* given = std::get_if<faces::GivenFaces>(&source)) return BuildGivenFaces(*given, options, directory);
  BuildFaces(std::get<faces::FaceModel>(source), options, directory);
}

}  // namespace daumier::datasets
