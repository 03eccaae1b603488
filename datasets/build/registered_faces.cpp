#include "datasets/build/registered_faces.h"

#include "core/error.h"
#include "core/files.h"
#include "core/log.h"
#include "core/parallel.h"
#include "core/safetensors.h"
#include "core/statistics.h"
#include "datasets/build/sharded_build.h"
#include "faces/face_database.h"
#include "geometry/registration_quality.h"

#include <algorithm>
#include <map>
#include <set>

namespace daumier::datasets {
namespace fs = std::filesystem;
namespace {

constexpr const char* kQualityFile = "quality.json";
/// Of the manifest's details, and of the metadata of a shard.
constexpr const char* kFailed = "failed";

geometry::NonRigidRegistration MakeRegistration(const faces::FaceTemplate& face, const std::vector<int>& present,
                                                const RegisterOptions& options) {
  geometry::RegistrationTemplate source{
      {face.neutral, face.triangles}, {}, {}, face.annotation.regions.at("neck_border")};
  source.landmark_weights.resize(Eigen::Index(present.size()));
  for (size_t k = 0; k < present.size(); ++k) {
    source.landmarks.push_back(face.annotation.landmarks[present[k]]);
    source.landmark_weights[Eigen::Index(k)] = present[k] < faces::kNumContourLandmarks ? options.contour_weight : 1.0;
  }
  return {std::move(source), options.registration};
}

Json SpreadJson(const std::optional<geometry::DistanceSpread>& distances, double mm_per_cm) {
  if (!distances) return nullptr;
  const geometry::DistanceSpread& spread = *distances;
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

/// Why a registration has failed; nothing where it has not.
std::optional<std::string> FaultOf(const geometry::RegistrationQuality& quality, double landmarks_mm,
                                   const RegistrationLimits& limits) {
  if (quality.coverage < limits.min_coverage || !quality.template_to_target)
    return fmt::format(
        "the registered template hardly lies on the mesh: {:.1f} % of the face has a match, expected {:.1f} % or "
        "more. Compare mesh and landmarks in a viewer: unit, frame, and that the face itself is in the mesh",
        100 * quality.coverage, 100 * limits.min_coverage);
  const double flipped = double(quality.flipped_region) / std::max(1, quality.num_region_triangles);
  if (flipped > limits.max_flipped)
    return fmt::format(
        "the registration folds the face: {:.1f} % of its triangles are flipped, expected {:.1f} % or less. "
        "Check the order of the landmarks",
        100 * flipped, 100 * limits.max_flipped);
  if (landmarks_mm > limits.max_landmarks_mm)
    return fmt::format(
        "the registration does not reach the landmarks: their mean distance is {:.1f} mm, expected {} mm or less. "
        "Check "
        "the order of the landmarks",
        landmarks_mm, limits.max_landmarks_mm);
  return std::nullopt;
}

/// A mesh that is ready to be registered.
struct Target {
  LandmarkedMesh mesh;
  Winding winding;
};

/// A target, or why there is none.
struct Preparation {
  std::optional<Target> target;
  FailedMesh failed;
};

Preparation Prepare(const faces::FaceTemplate& face, const MeshInputs& inputs, const RegisterOptions& options,
                    int index) {
  Preparation result;
  result.failed.name = NameOf(inputs.meshes.at(size_t(index)));
  try {
    LandmarkedMesh mesh = ReadLandmarkedMesh(inputs, index);
    const Winding winding = CheckAgainst(face, options.contour_weight, options.limits, mesh);
    result.target = Target{std::move(mesh), winding};
  } catch (const std::exception& error) {
    result.failed.cause = error.what();
  }
  return result;
}

/// A mesh that is within limits. @throws Error as NonRigidRegistration::Register, and if its result is beyond limits.
RegisteredMesh Registered(const geometry::NonRigidRegistration& registration, const faces::FaceTemplate& face,
                          const RegistrationLimits& limits, const Target& target) {
  const LandmarkedMesh& mesh = target.mesh;
  const geometry::Points landmarks = PlacesOf(mesh.landmarks);
  geometry::Registration result = registration.Register(mesh.mesh, landmarks);
  const geometry::SurfaceMatcher matcher({result.template_from_target.Apply(mesh.mesh.vertices), mesh.mesh.triangles});
  const geometry::RegistrationOptions& options = registration.options();
  geometry::RegistrationQuality quality =
      geometry::MeasureRegistration(registration.source().mesh, result.vertices,
                                    faces::RegionFor(face.annotation, "face", "the quality of a registration"), matcher,
                                    {options.max_distance_end, options.max_angle});
  const double landmark_error =
      (result.vertices(registration.source().landmarks, Eigen::all) - result.template_from_target.Apply(landmarks))
          .rowwise()
          .norm()
          .mean();
  const double mm_per_cm = faces::MillimetresPerCm(face);
  if (const auto fault = FaultOf(quality, landmark_error * mm_per_cm, limits)) throw Error(*fault);
  Json row = QualityJson(mesh.name, result, quality, landmark_error, mm_per_cm);
  if (target.winding == Winding::kTurned) row["turned_inside_out"] = true;
  return {std::move(result.vertices), std::move(quality.distances), result.template_from_target, std::move(row)};
}

SafetensorsWriter ShardOf(const RegisteredMesh& registered) {
  using Floats = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Floats vertices = registered.vertices.cast<float>();
  const Eigen::VectorXf distances = registered.distances.cast<float>();
  SafetensorsWriter writer;
  writer.SetMetadata("kind", "faces");
  writer.SetMetadata("quality", registered.row.dump());
  writer.Add<float>("vertices", {1, 1, vertices.rows(), 3}, {vertices.data(), size_t(vertices.size())});
  writer.Add<float>("identity_weights", {0}, {});
  writer.Add<float>("distances", {distances.size()}, {distances.data(), size_t(distances.size())});
  return writer;
}

/// A shard without arrays, whose metadata `failed` are the cause.
SafetensorsWriter FailedShard(const std::string& cause) {
  SafetensorsWriter writer;
  writer.SetMetadata("kind", "faces");
  writer.SetMetadata(kFailed, cause);
  return writer;
}

/// SHA-256 over names, positions, triangles and landmarks: names the exact meshes, however they are stored.
std::string ChecksumOf(const std::vector<Target>& targets) {
  std::string all;
  for (const Target& target : targets) {
    const geometry::Points landmarks = PlacesOf(target.mesh.landmarks);
    const auto bytes = [](const auto& matrix) {
      return std::string_view(reinterpret_cast<const char*>(matrix.data()), matrix.size() * sizeof(*matrix.data()));
    };
    all += target.mesh.name + Sha256(bytes(target.mesh.mesh.vertices)) + Sha256(bytes(target.mesh.mesh.triangles)) +
           Json(PresentLandmarks(target.mesh.landmarks)).dump() + Sha256(bytes(landmarks));
  }
  return Sha256(all);
}

/// The cause without the folders of the inputs, for files that hold no paths.
std::string WithoutFolders(std::string cause, const MeshInputs& inputs) {
  std::vector<fs::path> folders = {
      fs::is_directory(inputs.landmarks) ? inputs.landmarks : inputs.landmarks.parent_path(),
      inputs.vertex_map.parent_path()};
  for (const fs::path& mesh : inputs.meshes) folders.push_back(mesh.parent_path());
  for (const fs::path& folder : folders) cause = WithoutFolder(std::move(cause), folder);
  return cause;
}

Json FailedJson(const std::vector<FailedMesh>& failed, const MeshInputs& inputs) {
  Json json = Json::object();
  for (const FailedMesh& mesh : failed) json[mesh.name] = WithoutFolders(mesh.cause, inputs);
  return json;
}

/// Persons and failed meshes of a manifest.
void SetMeshes(Manifest& manifest, const std::vector<std::string>& names, const Json& failed) {
  manifest.counts["persons"] = names.size();
  manifest.counts["faces"] = names.size();
  manifest.details["meshes"] = names;
  manifest.details.erase(kFailed);
  if (!failed.empty()) manifest.details[kFailed] = failed;
}

/// Removes the shards that failed, and numbers the others again.
void KeepRegistered(const fs::path& directory, const Json& failed_before, Manifest& manifest) {
  const auto names = manifest.details.at("meshes").get<std::vector<std::string>>();
  std::vector<std::string> kept;
  Json failed = failed_before;
  for (size_t i = 0; i < names.size(); ++i) {
    const std::string shard = faces::PersonShardName(static_cast<int>(i));
    const auto metadata = SafetensorsFile(directory / shard).metadata();
    if (const auto cause = metadata.find(kFailed); cause != metadata.end()) {
      failed[names[i]] = cause->second;
      fs::remove(directory / shard);
      manifest.checksums.erase(shard);
      continue;
    }
    const std::string place = faces::PersonShardName(static_cast<int>(kept.size()));
    kept.push_back(names[i]);
    if (place == shard) continue;
    fs::rename(directory / shard, directory / place);
    manifest.checksums[place] = manifest.checksums.at(shard);
    manifest.checksums.erase(shard);
  }
  SetMeshes(manifest, kept, failed);
}

Json MeanOf(const std::vector<double>& values) {
  return values.empty() ? Json() : Json(Mean(values));
}

void WriteQuality(const fs::path& directory) {
  const faces::FaceDatabase database(directory, Checksums::kSkip);
  Json rows = Json::array();
  std::vector<double> there, back, coverage;
  int flipped = 0, flipped_matched = 0;
  for (int person = 0; person < database.num_persons(); ++person) {
    const Json& row = rows.emplace_back(ReadRegistrationQuality(directory, person));
    if (!row.at("template_to_target_mm").is_null())
      there.push_back(row.at("template_to_target_mm").at("mean").get<double>());
    back.push_back(row.at("target_to_template_mm").at("mean").get<double>());
    coverage.push_back(row.at("coverage").get<double>());
    flipped += row.at("flipped_face").get<int>();
    flipped_matched += row.at("flipped_matched").get<int>();
  }
  Json quality = {{"format_version", 1},
                  {"unit", "mm"},
                  {"summary",
                   {{"num_meshes", rows.size()},
                    {"template_to_target_mm", MeanOf(there)},
                    {"target_to_template_mm", MeanOf(back)},
                    {"coverage", MeanOf(coverage)},
                    {"flipped_face", flipped},
                    {"flipped_matched", flipped_matched}}},
                  {"meshes", rows}};
  const Json& details = database.manifest().details;
  if (details.contains(kFailed)) {
    quality["summary"]["num_failed"] = details.at(kFailed).size();
    quality["summary"][kFailed] = details.at(kFailed);
  }
  WriteFileAtomically(directory / kQualityFile, quality.dump(1) + "\n");
}

}  // namespace

RegisteredMesh RegisterMesh(const faces::FaceTemplate& face_template, LandmarkedMesh mesh,
                            const RegisterOptions& options) {
  const Winding winding = CheckAgainst(face_template, options.contour_weight, options.limits, mesh);
  const auto registration = MakeRegistration(face_template, PresentLandmarks(mesh.landmarks), options);
  return Registered(registration, face_template, options.limits, {std::move(mesh), winding});
}

RegisteredMesh RegisterMesh(const faces::FaceTemplate& face_template, const MeshInputs& inputs,
                            const RegisterOptions& options) {
  DAUMIER_CHECK(inputs.meshes.size() == 1, "{} meshes to register, expected one", inputs.meshes.size());
  return RegisterMesh(face_template, ReadLandmarkedMesh(inputs, 0), options);
}

std::string ListFailures(const std::vector<FailedMesh>& failed, size_t num_meshes) {
  const bool have_same_cause = std::all_of(failed.begin(), failed.end(),
                                           [&](const FailedMesh& mesh) { return mesh.cause == failed.front().cause; });
  if (failed.size() == num_meshes && have_same_cause) return failed.front().cause;
  std::string text = fmt::format("{} of {} meshes failed", failed.size(), num_meshes);
  for (const FailedMesh& mesh : failed) text += fmt::format("\n  {}: {}", mesh.name, mesh.cause);
  return text;
}

faces::FaceTemplate RegistrationTemplateOf(const RegisterOptions& options, const fs::path& template_folder) {
  if (template_folder.empty()) return faces::LoadFaceModel(options.source).face_template;
  return faces::ReadFaceTemplate(template_folder);
}

std::vector<FailedMesh> BuildRegisteredFaces(const faces::FaceTemplate& face_template, const MeshInputs& inputs,
                                             const RegisterOptions& options, const fs::path& directory,
                                             const Task& task) {
  if (inputs.meshes.empty()) throw UsageError("there is no mesh to register");
  std::set<std::string> taken;
  for (const fs::path& mesh : inputs.meshes) {
    if (!taken.insert(NameOf(mesh)).second) throw UsageError(fmt::format("two meshes have the name {}", NameOf(mesh)));
  }
  std::vector<Target> targets;
  std::vector<std::string> names;
  std::vector<FailedMesh> failed;
  std::map<std::vector<int>, geometry::NonRigidRegistration> registrations;  // By the present landmarks.
  ForEachInOrder(
      static_cast<int>(inputs.meshes.size()), [&](int i) { return Prepare(face_template, inputs, options, i); },
      [&](Preparation prepared) {
        if (!prepared.target) {
          failed.push_back(std::move(prepared.failed));
          return;
        }
        const Target& target = targets.emplace_back(std::move(*prepared.target));
        names.push_back(target.mesh.name);
        if (target.winding == Winding::kTurned)
          log::Warn("{}: the mesh is inside out; its triangles are turned", target.mesh.name);
        const std::vector<int> present = PresentLandmarks(target.mesh.landmarks);
        if (registrations.count(present) == 0)
          registrations.emplace(present, MakeRegistration(face_template, present, options));
      });
  if (targets.empty()) throw Error(ListFailures(failed, inputs.meshes.size()));

  const int num_targets = static_cast<int>(targets.size());
  const Json failed_before = FailedJson(failed, inputs);
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
  build.manifest.counts = {{"persons", num_targets},
                           {"levels", 1},
                           {"expressions", 1},
                           {"faces", num_targets},
                           {"vertices", face_template.num_vertices()}};
  build.manifest.details = {
      {"source", face_template.source}, {"gammas", Json::array({0.0})}, {"expressions", Json::array({"neutral"})}};
  SetMeshes(build.manifest, names, failed_before);
  build.num_shards = num_targets;
  build.unit = "meshes";
  build.shard_name = faces::PersonShardName;
  build.write_rest = [&](const fs::path& folder) { return faces::WriteFaceTemplate(folder, face_template); };
  build.write_shard = [&](int person, const fs::path& file) {
    const Target& target = targets[size_t(person)];
    const auto& registration = registrations.at(PresentLandmarks(target.mesh.landmarks));
    const auto shard = [&] {
      try {
        return ShardOf(Registered(registration, face_template, options.limits, target));
      } catch (const Error& error) {
        return FailedShard(error.what());
      }
    };
    return shard().Write(file);
  };
  const auto add_failures = [&](const Json& all) {
    for (const auto& [name, cause] : all.items()) {
      if (!failed_before.contains(name)) failed.push_back({name, cause.get<std::string>()});
    }
  };
  build.finish = [&](const fs::path& folder, Manifest& manifest) {
    KeepRegistered(folder, failed_before, manifest);
    if (!manifest.details.at("meshes").empty()) return;
    add_failures(manifest.details.at(kFailed));
    fs::remove_all(folder);
    throw Error(ListFailures(failed, inputs.meshes.size()));
  };
  if (fs::exists(directory / "manifest.json")) {
    // What failed in the finished build is not in its plan.
    const Json finished = ReadManifest(directory, "faces").details.value(kFailed, Json::object());
    std::erase_if(names, [&](const std::string& name) { return finished.contains(name); });
    Json all = failed_before;
    for (const auto& [name, cause] : finished.items()) {
      if (taken.count(name) && !all.contains(name)) all[name] = cause;
    }
    SetMeshes(build.manifest, names, all);
  }
  BuildShards(directory, build, task);
  add_failures(ReadManifest(directory, "faces").details.value(kFailed, Json::object()));
  WriteQuality(directory);
  return failed;
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
