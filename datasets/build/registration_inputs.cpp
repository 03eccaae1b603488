#include "datasets/build/registration_inputs.h"

#include "core/error.h"
#include "faces/import/mesh_folder.h"
#include "geometry/submesh.h"
#include "geometry/triangulate.h"

namespace daumier::datasets {
namespace fs = std::filesystem;
namespace {

/// Fewer landmarks hold neither place nor shape.
constexpr int kFewestLandmarks = 6;
constexpr const char* kLandmarkEndings[] = {".txt", ".json", ".pts",      ".pp",  ".csv",
                                            ".tsv", ".fcsv", ".mrk.json", ".xml", "_picked_points.pp"};

fs::path LandmarkPath(const MeshInputs& inputs, const std::string& name) {
  if (!fs::is_directory(inputs.landmarks)) return inputs.landmarks;
  std::string endings;
  for (const char* ending : kLandmarkEndings) {
    const fs::path path = inputs.landmarks / (name + ending);
    if (fs::exists(path)) return path;
    endings += fmt::format("{}{}", endings.empty() ? "" : ", ", name + ending);
  }
  throw Error(fmt::format("{}: there are no landmarks of the mesh {} (expected one of {})", inputs.landmarks.string(),
                          name, endings));
}

}  // namespace

std::string NameOf(const fs::path& mesh) {
  return mesh.stem().string();
}

std::vector<int> PresentLandmarks(const MeshLandmarks& landmarks) {
  std::vector<int> present;
  for (int l = 0; l < faces::kNumLandmarks; ++l) {
    if (landmarks[size_t(l)]) present.push_back(l);
  }
  return present;
}

geometry::Points PlacesOf(const MeshLandmarks& landmarks) {
  const std::vector<int> present = PresentLandmarks(landmarks);
  geometry::Points places(static_cast<Eigen::Index>(present.size()), 3);
  for (size_t k = 0; k < present.size(); ++k) places.row(Eigen::Index(k)) = *landmarks[size_t(present[k])];
  return places;
}

LandmarkedMesh ReadLandmarkedMesh(const MeshInputs& inputs, int index) {
  const fs::path& path = inputs.meshes.at(size_t(index));
  const geometry::PolygonMesh polygons = faces::ReadMesh(path);
  const std::string name = NameOf(path);
  const fs::path landmark_path = LandmarkPath(inputs, name);
  const LandmarkFile file(landmark_path, inputs.vertex_map, inputs.zero);
  // Without vertices that no polygon uses, among them all that are not finite.
  const auto used =
      geometry::Submesh(polygons, geometry::MapKept(polygons.corners, static_cast<int>(polygons.vertices.rows())));
  LandmarkedMesh result{name,
                        landmark_path,
                        {used.vertices, geometry::Triangulate(used)},
                        file.On(polygons.vertices),
                        file.ShiftedOn(polygons.vertices)};
  DAUMIER_CHECK(result.mesh.triangles.rows() > 0, "{}: no polygon has three corners that differ", path.string());
  for (const int l : PresentLandmarks(result.landmarks))
    DAUMIER_CHECK(result.landmarks[size_t(l)]->allFinite(),
                  "{}: landmark {} is a vertex of {} that is not finite. Mark it elsewhere, or as absent (nan nan nan)",
                  landmark_path.string(), l, path.string());
  const auto num_landmarks = PresentLandmarks(result.landmarks).size();
  DAUMIER_CHECK(num_landmarks >= kFewestLandmarks, "{}: {} of 68 landmarks are present, expected {} or more",
                path.string(), num_landmarks, kFewestLandmarks);
  return result;
}

void TurnTriangles(geometry::TriangleMesh& mesh) {
  mesh.triangles.col(1).swap(mesh.triangles.col(2));
}

Winding CheckAgainst(const faces::FaceTemplate& face, double contour_weight, const RegistrationLimits& limits,
                     LandmarkedMesh& target) {
  const FitInput input{face, target.mesh, target.landmarks, target.shifted, contour_weight};
  LandmarkFit fit;
  std::optional<std::string> fault;
  try {
    fault = FaultOfOnePlace(target.landmarks);
    if (!fault) fault = FaultOfPlane(target.mesh, target.landmarks);
    if (!fault) {
      fit = MeasureLandmarkFit(input);
      fault = FaultOfLandmarks(input, fit, limits);
    }
  } catch (const Error& error) {
    fault = error.what();
  }
  DAUMIER_CHECK(!fault, "{}: {}", target.landmark_file.string(), *fault);
  if (fit.normals >= 0) return Winding::kAsStored;
  TurnTriangles(target.mesh);
  return Winding::kTurned;
}

}  // namespace daumier::datasets
