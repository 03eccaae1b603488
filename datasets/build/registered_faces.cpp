#include "datasets/build/registered_faces.h"

#include "core/error.h"
#include "core/files.h"
#include "core/safetensors.h"
#include "datasets/build/sharded_build.h"
#include "faces/face_database.h"
#include "faces/import/mesh_folder.h"
#include "geometry/registration_quality.h"
#include "geometry/triangulate.h"

#include <algorithm>
#include <map>
#include <set>

namespace daumier::datasets {
namespace fs = std::filesystem;
namespace {

constexpr int kNumContour = 17;
/// Fewer landmarks hold neither place nor shape.
constexpr int kFewestLandmarks = 6;
constexpr const char* kQualityFile = "quality.json";

fs::path LandmarkPath(const MeshInputs& inputs, const std::string& name) {
  if (!fs::is_directory(inputs.landmarks)) return inputs.landmarks;
  for (const char* extension : {".txt", ".json"}) {
    const fs::path path = inputs.landmarks / (name + extension);
    if (fs::exists(path)) return path;
  }
  throw Error(
      fmt::format("{}: there is no {}.txt or {}.json for the mesh {}", inputs.landmarks.string(), name, name, name));
}

/// Indices of the present ones of the 68 landmarks.
std::vector<int> Present(const MeshLandmarks& landmarks) {
  std::vector<int> present;
  for (int l = 0; l < static_cast<int>(landmarks.size()); ++l) {
    if (landmarks[l]) present.push_back(l);
  }
  return present;
}

geometry::Points PlacesOf(const MeshLandmarks& landmarks, const std::vector<int>& present) {
  geometry::Points places(present.size(), 3);
  for (size_t k = 0; k < present.size(); ++k) places.row(Eigen::Index(k)) = *landmarks[present[k]];
  return places;
}

geometry::NonRigidRegistration MakeRegistration(const faces::FaceTemplate& face, const std::vector<int>& present,
                                                const RegisterOptions& options) {
  geometry::RegistrationTemplate source{
      {face.neutral, face.triangles}, {}, {}, face.annotation.regions.at("neck_border")};
  source.landmark_weights.resize(Eigen::Index(present.size()));
  for (size_t k = 0; k < present.size(); ++k) {
    source.landmarks.push_back(face.annotation.landmarks[present[k]]);
    source.landmark_weights[Eigen::Index(k)] = present[k] < kNumContour ? options.contour_weight : 1.0;
  }
  return {std::move(source), options.registration};
}

Json SpreadJson(const geometry::DistanceSpread& spread, double mm_per_cm) {
  return {{"mean", spread.mean * mm_per_cm}, {"median", spread.median * mm_per_cm}, {"p95", spread.p95 * mm_per_cm}};
}

Json QualityJson(const std::string& name, const geometry::Registration& result,
                 const geometry::RegistrationQuality& quality, double landmark_error, double mm_per_cm) {
  const geometry::Similarity& similarity = result.template_from_target;
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> rotation = similarity.rotation;
  return {{"name", name},
          {"template_to_target_mm", SpreadJson(quality.template_to_target, mm_per_cm)},
          {"target_to_template_mm", SpreadJson(quality.target_to_template, mm_per_cm)},
          {"landmarks_mm", landmark_error * mm_per_cm},
          {"coverage", quality.coverage},
          {"target_reached", quality.target_reached},
          {"flipped_face", quality.flipped_region},
          {"flipped_matched", quality.flipped_matched},
          {"self_intersections", quality.self_intersections},
          {"self_intersections_at_rest", quality.self_intersections_at_rest},
          {"template_from_target",
           {{"scale", similarity.scale},
            {"rotation", std::vector<double>(rotation.data(), rotation.data() + 9)},
            {"translation", std::vector<double>(similarity.translation.begin(), similarity.translation.end())}}}};
}

/// Registers one mesh and writes its shard.
std::string WriteShard(const geometry::NonRigidRegistration& registration, const faces::FaceTemplate& face,
                       const LandmarkedMesh& target, const fs::path& file) {
  const geometry::Points landmarks = PlacesOf(target.landmarks, Present(target.landmarks));
  const geometry::Registration result = registration.Register(target.mesh, landmarks);
  const geometry::SurfaceMatcher matcher(
      {result.template_from_target.Apply(target.mesh.vertices), target.mesh.triangles});
  const geometry::RegistrationOptions& options = registration.options();
  const geometry::RegistrationQuality quality =
      geometry::MeasureRegistration(registration.source().mesh, result.vertices,
                                    faces::RegionFor(face.annotation, "face", "the quality of a registration"), matcher,
                                    {options.max_distance_end, options.max_angle});
  const double landmark_error =
      (result.vertices(registration.source().landmarks, Eigen::all) - result.template_from_target.Apply(landmarks))
          .rowwise()
          .norm()
          .mean();
  using Floats = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Floats vertices = result.vertices.cast<float>();
  const Eigen::VectorXf distances = quality.distances.cast<float>();
  SafetensorsWriter writer;
  writer.SetMetadata("kind", "faces");
  writer.SetMetadata("quality",
                     QualityJson(target.name, result, quality, landmark_error, faces::MillimetresPerCm(face)).dump());
  writer.Add<float>("vertices", {1, 1, vertices.rows(), 3}, {vertices.data(), size_t(vertices.size())});
  writer.Add<float>("identity_weights", {0}, {});
  writer.Add<float>("distances", {distances.size()}, {distances.data(), size_t(distances.size())});
  return writer.Write(file);
}

/// SHA-256 over names, positions, triangles and landmarks: names the exact meshes, however they are stored.
std::string ChecksumOf(const std::vector<LandmarkedMesh>& targets) {
  std::string all;
  for (const LandmarkedMesh& target : targets) {
    const geometry::Points landmarks = PlacesOf(target.landmarks, Present(target.landmarks));
    const auto bytes = [](const auto& matrix) {
      return std::string_view(reinterpret_cast<const char*>(matrix.data()), matrix.size() * sizeof(*matrix.data()));
    };
    all += target.name + Sha256(bytes(target.mesh.vertices)) + Sha256(bytes(target.mesh.triangles)) +
           Json(Present(target.landmarks)).dump() + Sha256(bytes(landmarks));
  }
  return Sha256(all);
}

void WriteQuality(const fs::path& directory, int num_persons) {
  Json rows = Json::array();
  double mean = 0, back = 0, coverage = 0;
  int flipped = 0, flipped_matched = 0;
  for (int person = 0; person < num_persons; ++person) {
    const Json& row = rows.emplace_back(ReadRegistrationQuality(directory, person));
    mean += row.at("template_to_target_mm").at("mean").get<double>() / num_persons;
    back += row.at("target_to_template_mm").at("mean").get<double>() / num_persons;
    coverage += row.at("coverage").get<double>() / num_persons;
    flipped += row.at("flipped_face").get<int>();
    flipped_matched += row.at("flipped_matched").get<int>();
  }
  const Json quality = {{"format_version", 1},
                        {"unit", "mm"},
                        {"summary",
                         {{"num_meshes", num_persons},
                          {"template_to_target_mm", mean},
                          {"target_to_template_mm", back},
                          {"coverage", coverage},
                          {"flipped_face", flipped},
                          {"flipped_matched", flipped_matched}}},
                        {"meshes", rows}};
  WriteFileAtomically(directory / kQualityFile, quality.dump(1) + "\n");
}

}  // namespace

LandmarkedMesh ReadLandmarkedMesh(const MeshInputs& inputs, int index) {
  const fs::path& path = inputs.meshes.at(index);
  const geometry::PolygonMesh polygons = faces::ReadMesh(path);
  LandmarkedMesh result{path.stem().string(), {polygons.vertices, geometry::Triangulate(polygons)}, {}};
  result.landmarks = LandmarkFile(LandmarkPath(inputs, result.name), inputs.vertex_map).On(polygons.vertices);
  const auto num_landmarks = Present(result.landmarks).size();
  DAUMIER_CHECK(num_landmarks >= kFewestLandmarks, "{}: {} of 68 landmarks are present, expected {} or more",
                path.string(), num_landmarks, kFewestLandmarks);
  return result;
}

faces::FaceTemplate RegistrationTemplateOf(const RegisterOptions& options, const fs::path& template_folder) {
  if (template_folder.empty()) return faces::LoadFaceModel(options.source).face_template;
  return faces::ReadFaceTemplate(template_folder);
}

void BuildRegisteredFaces(const faces::FaceTemplate& face_template, const MeshInputs& inputs,
                          const RegisterOptions& options, const fs::path& directory, const Task& task) {
  if (inputs.meshes.empty()) throw UsageError("there is no mesh to register");
  const int num_meshes = static_cast<int>(inputs.meshes.size());
  std::vector<LandmarkedMesh> targets;
  Json names = Json::array();
  std::set<std::string> taken;
  std::map<std::vector<int>, geometry::NonRigidRegistration> registrations;  // By the present landmarks.
  for (int i = 0; i < num_meshes; ++i) {
    const LandmarkedMesh& target = targets.emplace_back(ReadLandmarkedMesh(inputs, i));
    if (!taken.insert(target.name).second) throw UsageError(fmt::format("two meshes have the name {}", target.name));
    names.push_back(target.name);
    const std::vector<int> present = Present(target.landmarks);
    if (registrations.count(present) == 0)
      registrations.emplace(present, MakeRegistration(face_template, present, options));
  }

  ShardedBuild build;
  build.manifest.kind = "faces";
  build.manifest.verb = "register";
  build.manifest.config = ToJson(options);
  build.manifest.config.erase("source");
  build.manifest.sources = Json::array({face_template.provenance,
                                        {{"name", "registered meshes"},
                                         {"version", ""},
                                         {"checksum", ChecksumOf(targets)},
                                         {"licence", options.licence}}});
  build.manifest.counts = {{"persons", num_meshes},
                           {"levels", 1},
                           {"expressions", 1},
                           {"faces", num_meshes},
                           {"vertices", face_template.num_vertices()}};
  build.manifest.details = {{"source", face_template.source},
                            {"gammas", Json::array({0.0})},
                            {"expressions", Json::array({"neutral"})},
                            {"meshes", names}};
  build.num_shards = num_meshes;
  build.unit = "meshes";
  build.shard_name = faces::PersonShardName;
  build.write_rest = [&](const fs::path& folder) { return faces::WriteFaceTemplate(folder, face_template); };
  build.write_shard = [&](int person, const fs::path& file) {
    const LandmarkedMesh& target = targets[person];
    return WriteShard(registrations.at(Present(target.landmarks)), face_template, target, file);
  };
  BuildShards(directory, build, task);
  WriteQuality(directory, num_meshes);
}

Json ReadRegistrationQuality(const fs::path& directory, int person) {
  const fs::path path = directory / faces::PersonShardName(person);
  const SafetensorsFile shard(path);
  const auto quality = shard.metadata().find("quality");
  DAUMIER_CHECK(quality != shard.metadata().end(), "{}: no registered face: the metadata lack `quality`",
                path.string());
  return ParseJson(quality->second, path.string());
}

}  // namespace daumier::datasets
