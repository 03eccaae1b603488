#include "datasets/build/faces.h"

#include "core/error.h"
#include "core/safetensors.h"
#include "datasets/build/sharded_build.h"
#include "faces/face_database.h"

#include <algorithm>
#include <set>

namespace daumier::datasets {
namespace {

/// The expressions that the options name, in their order; all of the model if they name none.
std::vector<faces::Expression> ChooseExpressions(const faces::FaceModel& model, const std::vector<std::string>& names) {
  std::vector<faces::Expression> chosen;
  std::set<std::string> known, taken;
  for (const faces::Expression& expression : model.expressions) known.insert(expression.name);
  for (const std::string& name : names) {
    const auto found = std::find_if(model.expressions.begin(), model.expressions.end(),
                                    [&](const faces::Expression& expression) { return expression.name == name; });
    if (found == model.expressions.end()) {
      const std::string near = NearestWord(name, known);
      throw UsageError(fmt::format(
          "source {} has no expression '{}'; {}", model.face_template.source, name,
          near.empty() ? fmt::format("it has: {}", fmt::join(known, ", ")) : fmt::format("did you mean '{}'?", near)));
    }
    if (!taken.insert(name).second) throw UsageError(fmt::format("expression '{}' is named twice", name));
    chosen.push_back(*found);
  }
  if (names.empty()) chosen = model.expressions;
  if (chosen.front().name != "neutral") throw UsageError("the first of expressions has to be neutral");
  return chosen;
}

/// All faces of a person, (levels, expressions, 3V), next to each other.
std::vector<float> PersonVertices(const faces::FaceModel& model, const Eigen::VectorXf& identity,
                                  const Eigen::MatrixXf& offsets, const faces::ExaggerationOptions& exaggeration) {
  const geometry::Points neutral = faces::IdentityFace(model, identity);
  std::vector<float> vertices;
  vertices.reserve(exaggeration.gammas.size() * offsets.size());
  for (const geometry::Points& level : faces::Exaggerate(model.face_template, neutral, exaggeration)) {
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
  const std::vector<double>& gammas = options.exaggeration.gammas;
  if (gammas.empty() || gammas.front() != 0.0) throw UsageError("the first of exaggeration.gammas has to be 0");
  const std::vector<faces::Expression> expressions = ChooseExpressions(model, options.expressions);
  Json names = Json::array();
  Eigen::MatrixXf offsets(model.face_template.neutral.size(), expressions.size());
  for (size_t e = 0; e < expressions.size(); ++e) {
    names.push_back(expressions[e].name);
    offsets.col(Eigen::Index(e)) = faces::ExpressionOffset(model, expressions[e].weights);
  }

  const int num_levels = static_cast<int>(gammas.size()), num_expressions = static_cast<int>(expressions.size());
  const int num_vertices = model.face_template.num_vertices();
  ShardedBuild build;
  build.manifest.kind = "faces";
  build.manifest.verb = "dataset faces";
  build.manifest.config = ToJson(options);
  build.manifest.config["source"].erase("path");
  build.manifest.seed = options.seed;
  build.manifest.sources = Json::array({model.face_template.provenance});
  build.manifest.counts = {{"persons", options.num_persons},
                           {"levels", num_levels},
                           {"expressions", num_expressions},
                           {"faces", int64_t(options.num_persons) * num_levels * num_expressions},
                           {"vertices", num_vertices}};
  build.manifest.details = {{"source", model.face_template.source}, {"gammas", gammas}, {"expressions", names}};

  build.write_rest = [&](const std::filesystem::path& folder) {
    return faces::WriteFaceTemplate(folder, model.face_template);
  };
  build.num_shards = options.num_persons;
  build.unit = "faces";
  build.units_per_shard = num_levels * num_expressions;
  build.shard_name = faces::PersonShardName;
  build.write_shard = [&](int person, const std::filesystem::path& file) {
    Rng rng = Stream(options.seed, "identity", person);
    const Eigen::VectorXf identity = faces::DrawIdentity(model, rng, options.identity_spread);
    const std::vector<float> vertices = PersonVertices(model, identity, offsets, options.exaggeration);
    SafetensorsWriter writer;
    writer.SetMetadata("kind", "faces");
    writer.Add<float>("vertices", {num_levels, num_expressions, num_vertices, 3}, vertices);
    writer.Add<float>("identity_weights", {identity.size()}, {identity.data(), static_cast<size_t>(identity.size())});
    return writer.Write(file);
  };
  BuildShards(directory, build);
}

void BuildFaces(const FacesOptions& options, const std::filesystem::path& directory) {
  BuildFaces(faces::LoadFaceModel(options.source), options, directory);
}

}  // namespace daumier::datasets
