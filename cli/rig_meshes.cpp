#include "cli/rig_foreign.h"
#include "cli/rig_map.h"
#include "cli/weights_output.h"
#include "core/error.h"
#include "core/log.h"
#include "core/parallel.h"
#include "core/stopwatch.h"
#include "faces/import/given_faces.h"
#include "faces/import/mesh_folder.h"
#include "geometry/alignment.h"
#include "geometry/normals.h"
#include "rig/arkit_names.h"
#include "rig/expression_targets.h"
#include "rig/mesh_weights.h"
#include "rig/weight_limits.h"

#include <algorithm>

namespace daumier::cli {
namespace {

namespace fs = std::filesystem;

constexpr float kMovesCm = 0.01f;  // At weight 1: vertices that move less are not of the face.
constexpr double kMmPerCm = 10;

/// A person's neutral head with its targets.
struct NeutralHead {
  geometry::TriangleMesh mesh;  ///< V x 3, cm.
  rig::MorphTargets targets;
  Json facts = Json::object();
  std::string source, licence;
};

NeutralHead NeutralHeadOf(const GivenFace& given, const fs::path& landmarks,
                          const std::optional<faces::SourceOptions>& source) {
  if (const auto face = landmarks.empty() ? ReadFaceToRig(given, source, ShownExpression::kKept) : std::nullopt) {
    const rig::ExpressionTargets targets(face->model);
    for (const std::string& warning : targets.warnings()) log::Warn("{}", warning);
    const faces::FaceTemplate& face_template = face->model.face_template;
    return {{face->neutral, face_template.triangles},
            targets.On(face->neutral),
            Json::object(),
            face_template.source,
            face_template.provenance.value("licence", "unknown licence")};
  }
  RiggedForeignHead foreign = RigForeignHead(given, landmarks, ModelForForeignHeads(source), TakenLook::kNone);
  return {{std::move(foreign.head.mesh.vertices), std::move(foreign.head.mesh.triangles)},
          std::move(foreign.head.targets),
          std::move(foreign.facts),
          std::move(foreign.head.source),
          std::move(foreign.head.licence)};
}

/// Areas of the vertices that some target moves.
Eigen::VectorXd MassesOf(const NeutralHead& head) {
  Eigen::VectorXd masses = geometry::VertexAreas(head.mesh);
  for (Eigen::Index v = 0; v < masses.size(); ++v)
    if (head.targets.offsets.middleRows<3>(3 * v).colwise().norm().maxCoeff() < kMovesCm) masses[v] = 0;
  return masses;
}

geometry::Points ReadMeshOf(const fs::path& file, const GivenFace& given) {
  const geometry::PolygonMesh mesh = faces::ReadMesh(file);
  const Eigen::Index expected = given.mesh.vertices.rows();
  DAUMIER_CHECK(mesh.vertices.rows() == expected,
                "{} has {} vertices, {} {}: it is of another topology. Give meshes of one sequence, with the order of "
                "vertices kept",
                file.string(), mesh.vertices.rows(), given.file.string(), expected);
  if (given.is_mesh && mesh.num_polygons() > 0) faces::CheckSameTopology(mesh, given.mesh, file.string());
  DAUMIER_CHECK(mesh.vertices.allFinite(), "{} has a vertex that is no finite number. Export it again", file.string());
  return mesh.vertices;
}

Json ErrorsOf(const rig::MeshWeights& solved) {
  return {{"rms_mm", kMmPerCm * solved.error.rms_cm},
          {"max_mm", kMmPerCm * solved.error.greatest_cm},
          {"no_motion_rms_mm", kMmPerCm * solved.at_rest.rms_cm}};
}

}  // namespace

void WeighMeshes(const MapArguments& arguments, const fs::path& face, const fs::path& landmarks,
                 const std::optional<faces::SourceOptions>& source, const MapOutput& output) {
  const Stopwatch watch;
  std::vector<fs::path> inputs = arguments.meshes;
  inputs.insert(inputs.end(), {face, landmarks});
  CheckWeightsFile(output, inputs);
  const GivenFace given = ReadGivenFace(face);
  ReadMeshOf(arguments.meshes.front(), given);  // Before the head is registered, which takes long.
  const NeutralHead head = NeutralHeadOf(given, landmarks, source);
  const Eigen::Index num_vertices = head.mesh.vertices.rows();
  // The head's own axes and unit: the way of its neutral mesh is that of every mesh.
  const geometry::Similarity head_from_file =
      geometry::AlignSimilarity(given.mesh.vertices.topRows(num_vertices), head.mesh.vertices);
  const rig::WeightSolver solver(
      head.targets, MassesOf(head),
      rig::MostWeights(1, arguments.has_gaze ? rig::GazeTargets::kUsed : rig::GazeTargets::kZero));

  rig::WeightsClip clip;
  clip.names.assign(rig::ArkitNames().begin(), rig::ArkitNames().end());
  clip.weights.resize(std::ssize(arguments.meshes), rig::kNumArkitNames);
  Json errors = Json::array();
  double sum = 0, sum_at_rest = 0, worst = -1;
  std::string worst_name;
  ForEachInOrder(
      int(arguments.meshes.size()),
      [&](int i) {
        const geometry::Points mesh = ReadMeshOf(arguments.meshes[size_t(i)], given);
        return rig::WeightsOfMesh(solver, head.mesh.vertices, head_from_file.Apply(mesh.topRows(num_vertices)));
      },
      [&](const rig::MeshWeights& solved) {
        const std::string name = arguments.meshes[errors.size()].string();
        clip.weights.row(Eigen::Index(errors.size())) = solved.weights.cast<float>();
        Json row = {{"mesh", name}};
        row.update(ErrorsOf(solved));
        errors.push_back(std::move(row));
        sum += kMmPerCm * solved.error.rms_cm;
        sum_at_rest += kMmPerCm * solved.at_rest.rms_cm;
        if (solved.error.rms_cm > worst) worst_name = name;
        worst = std::max(worst, solved.error.rms_cm);
      });
  const Eigen::MatrixXf solved_weights = clip.weights;
  rig::LimitWeights(clip);
  const auto num_limited =
      ((clip.weights - solved_weights).rowwise().lpNorm<Eigen::Infinity>().array() > 1e-4f).count();
  WriteWeights(output.out, {.weights = clip.weights,
                            .seconds = EvenSeconds(clip.num_frames(), arguments.frames_per_second),
                            .remarks = {fmt::format("targets: {}; {}", head.source, head.licence)}});
  const double count = double(errors.size());
  Json result = {{"weights", output.out.string()},          {"frames", clip.num_frames()},   {"rms_mm", sum / count},
                 {"no_motion_rms_mm", sum_at_rest / count}, {"limited_frames", num_limited}, {"worst", worst_name},
                 {"worst_rms_mm", kMmPerCm * worst}};
  if (output.as_json) result["meshes"] = std::move(errors);
  result.update(head.facts);
  result["seconds"] = watch.seconds();
  PrintResult(result, output.as_json);
}

}  // namespace daumier::cli
