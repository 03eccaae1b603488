#include "datasets/gallery/registration_pictures.h"

#include "core/error.h"
#include "core/safetensors.h"
#include "geometry/obj.h"
#include "render/draw.h"
#include "render/heat_map.h"
#include "render/sheet.h"
#include "reports/face_surface.h"

#include <fmt/format.h>

#include <algorithm>

namespace daumier::datasets {
namespace {

constexpr int kCell = 360;  // Pixels a side of a picture in a sheet.
constexpr render::ValueRange kDistances = {0.0, 2.0};

std::vector<std::string> MeshNames(const faces::FaceDatabase& database) {
  const auto names = database.manifest().details.find("meshes");
  DAUMIER_CHECK(names != database.manifest().details.end(), "{}: holds no registered meshes",
                database.directory().string());
  return names->get<std::vector<std::string>>();
}

geometry::Similarity SimilarityFromJson(const Json& json) {
  const auto rotation = json.at("rotation").get<std::vector<double>>();
  const auto translation = json.at("translation").get<std::vector<double>>();
  return {json.at("scale").get<double>(),
          Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rotation.data()),
          Eigen::Map<const geometry::Vector3>(translation.data())};
}

/// The input of this name.
int InputOf(const std::string& name, const MeshInputs& inputs) {
  const auto found = std::find_if(inputs.meshes.begin(), inputs.meshes.end(),
                                  [&](const std::filesystem::path& mesh) { return NameOf(mesh) == name; });
  DAUMIER_CHECK(found != inputs.meshes.end(), "the database has a mesh {}, which is none of the {} inputs", name,
                inputs.meshes.size());
  return static_cast<int>(found - inputs.meshes.begin());
}

/// Millimetres from each vertex to the mesh.
Eigen::VectorXd Distances(const faces::FaceDatabase& database, int person) {
  const SafetensorsFile shard(database.directory() / faces::PersonShardName(person));
  const auto distances = shard.at("distances").As<float>();
  return faces::MillimetresPerCm(database.face_template()) *
         Eigen::Map<const Eigen::VectorXf>(distances.data(), Eigen::Index(distances.size())).cast<double>();
}

}  // namespace

void WriteRegistrationPictures(const faces::FaceDatabase& database, const MeshInputs& inputs,
                               const std::filesystem::path& folder) {
  const std::vector<std::string> names = MeshNames(database);
  const faces::FinishedHead head(database.face_template());
  for (int person = 0; person < database.num_persons(); ++person) {
    LandmarkedMesh target = ReadLandmarkedMesh(inputs, InputOf(names[size_t(person)], inputs));
    const Json quality = ReadRegistrationQuality(database.directory(), person);
    if (quality.value("turned_inside_out", false)) TurnTriangles(target.mesh);
    const geometry::Similarity similarity = SimilarityFromJson(quality.at("template_from_target"));
    const render::RenderInput mesh{.surface = {similarity.Apply(target.mesh.vertices), target.mesh.triangles}};
    const render::RenderInput registered = reports::InputOf(head, database.points(database.index({person, 0, 0})));
    const Eigen::VectorXd distances = head.Values(Distances(database, person));
    const render::Frame frame = render::FrameOf(registered.surface.vertices.topRows(head.num_face_vertices()));
    std::vector<render::SheetCell> cells;
    for (const double yaw : {0.0, -60.0}) {
      const render::Camera camera = render::TurnedCamera(frame.centre, frame.half_height, kCell, yaw);
      render::Image heat(kCell, kCell + render::kColourBarWidth, 3);
      render::Paste(heat, render::RenderHeatMap(registered, distances, kDistances, camera), 0, 0);
      render::DrawColourBar(heat, kDistances, "mm");
      cells.push_back({render::RenderMesh(mesh, camera)});
      cells.push_back({render::RenderMesh(registered, camera)});
      cells.push_back({std::move(heat)});
    }
    const Json& distance = quality.at("template_to_target_mm");
    render::SheetStyle style;
    const std::string measured = distance.is_null()
                                     ? "no match"
                                     : fmt::format("mean {:.2f} mm, p95 {:.2f} mm", distance.at("mean").get<double>(),
                                                   distance.at("p95").get<double>());
    style.title =
        fmt::format("{}: {}, coverage {:.0f} %", target.name, measured, 100 * quality.at("coverage").get<double>());
    style.column_titles = {"mesh", "registered", "distance"};
    render::WriteImage(folder / (target.name + ".jpg"), render::MakeSheet(cells, 3, style));
  }
}

void WriteRegisteredMeshes(const faces::FaceDatabase& database, const std::filesystem::path& folder) {
  const std::vector<std::string> names = MeshNames(database);
  for (int person = 0; person < database.num_persons(); ++person) {
    geometry::WriteObj(folder / (names[person] + ".obj"),
                       faces::SurfaceMesh(database.face_template(), database.points(database.index({person, 0, 0}))));
  }
}

}  // namespace daumier::datasets
