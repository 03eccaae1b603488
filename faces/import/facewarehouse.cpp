#include "faces/import/facewarehouse.h"

#include "core/error.h"
#include "core/files.h"
#include "faces/import/mesh_folder.h"

#include <charconv>
#include <cstring>
#include <map>
#include <memory>

namespace daumier::faces {

namespace {

namespace fs = std::filesystem;

constexpr int kNumPoses = 20;
constexpr size_t kShapeHeaderBytes = 12;
constexpr int kMaxShapes = 1000;
constexpr double kCmPerUnit = 10;

/// The folders Tester_k by k.
std::map<int, fs::path> FindTesters(const fs::path& folder) {
  DAUMIER_CHECK(fs::is_directory(folder), "{} is not a folder", folder.string());
  std::map<int, fs::path> testers;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string(), prefix = "Tester_";
    int number = 0;
    if (!entry.is_directory() || !name.starts_with(prefix)) continue;
    const char* const end = name.data() + name.size();
    if (std::from_chars(name.data() + prefix.size(), end, number).ptr == end) testers[number] = entry.path();
  }
  DAUMIER_CHECK(!testers.empty(), "{} holds no folder Tester_1, Tester_2, ...; is it FaceWarehouse?", folder.string());
  return testers;
}

fs::path FindTemplate(const std::map<int, fs::path>& testers, const fs::path& folder) {
  for (const auto& [number, tester] : testers) {
    for (const char* mesh : {"Blendshape/shape_0.obj", "TrainingPose/pose_0.obj"}) {
      if (fs::exists(tester / mesh)) return tester / mesh;
    }
  }
  throw UsageError(
      fmt::format("{}: no Blendshape/shape_0.obj or TrainingPose/pose_0.obj holds the polygons of shape.bs; set "
                  "source.template_mesh "
                  "to a mesh of FaceWarehouse's topology",
                  folder.string()));
}

fs::path ShapeFileOf(const fs::path& tester) {
  return tester / "Blendshape/shape.bs";
}

fs::path PoseFile(const fs::path& tester, int pose) {
  return tester / fmt::format("TrainingPose/pose_{}.obj", pose);
}

}  // namespace

int CountShapes(std::string_view bytes, int num_vertices, const std::string& name) {
  DAUMIER_CHECK(bytes.size() >= kShapeHeaderBytes, "{}: truncated: {} bytes", name, bytes.size());
  int32_t header[3];
  std::memcpy(header, bytes.data(), kShapeHeaderBytes);
  DAUMIER_CHECK(header[0] >= 1 && header[0] <= kMaxShapes && header[1] > 0,
                "{}: header claims {} shapes of {} vertices; not a shape.bs file", name, header[0], header[1]);
  DAUMIER_CHECK(header[1] == num_vertices, "{}: shapes of {} vertices, the template has {}", name, header[1],
                num_vertices);
  const int num_shapes = header[0] + 1;
  const size_t needed = kShapeHeaderBytes + size_t(num_shapes) * num_vertices * 3 * sizeof(float);
  DAUMIER_CHECK(bytes.size() >= needed, "{}: truncated: {} bytes, {} shapes of {} vertices need {}", name, bytes.size(),
                num_shapes, num_vertices, needed);
  return num_shapes;
}

geometry::Points ReadShape(std::string_view bytes, int shape, int num_vertices, const std::string& name) {
  const int num_shapes = CountShapes(bytes, num_vertices, name);
  DAUMIER_CHECK(shape >= 0 && shape < num_shapes, "{}: shape {} of {}", name, shape, num_shapes);
  Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor> points(num_vertices, 3);
  const size_t size = sizeof(float) * static_cast<size_t>(points.size());
  std::memcpy(points.data(), bytes.data() + kShapeHeaderBytes + shape * size, size);
  DAUMIER_CHECK(points.allFinite(), "{}: a position of shape {} is not finite", name, shape);
  return points.cast<double>();
}

GivenFaces LoadFaceWarehouse(const fs::path& folder, const fs::path& template_mesh, FaceWarehouseSet set,
                             const AnnotationFile& annotation) {
  const std::map<int, fs::path> testers = FindTesters(folder);
  const bool is_blend = set == FaceWarehouseSet::kBlendshapes;
  GivenFiles files;
  const auto mesh = std::make_shared<const geometry::PolygonMesh>(
      ReadMesh(template_mesh.empty() ? FindTemplate(testers, folder) : template_mesh));
  const int num_vertices = static_cast<int>(mesh->vertices.rows());
  std::vector<fs::path> folders;
  for (const auto& [number, tester] : testers) {
    files.names.push_back(fmt::format("Tester_{}", number));
    folders.push_back(tester);
  }
  int num_expressions = kNumPoses;
  if (is_blend) {
    const fs::path first = ShapeFileOf(folders.front());
    num_expressions = CountShapes(MappedFile(first).bytes(), num_vertices, first.string());
  }
  files.expressions = {"neutral"};
  for (int e = 1; e < num_expressions; ++e)
    files.expressions.push_back(fmt::format("{}_{}", is_blend ? "shape" : "pose", e));
  files.source = is_blend ? "facewarehouse" : "facewarehouse_poses";
  files.mesh = *mesh;
  files.groups = files.names;
  files.cm_per_unit = kCmPerUnit;
  files.provenance = {{"name", "FaceWarehouse"},
                      {"version", is_blend ? "Blendshape" : "TrainingPose"},
                      {"checksum", ""},
                      {"licence", "FaceWarehouse's terms: research only, on application; not to be passed on"}};
  files.face = [=](int identity, int expression) -> geometry::Points {
    const fs::path& tester = folders.at(identity);
    if (is_blend) {
      const MappedFile file(ShapeFileOf(tester));
      return ReadShape(file.bytes(), expression, num_vertices, ShapeFileOf(tester).string());
    }
    const fs::path path = PoseFile(tester, expression);
    const geometry::PolygonMesh pose = ReadMesh(path);
    CheckSameTopology(pose, *mesh, path.string());
    return pose.vertices;
  };
  return ImportGivenFaces(files, annotation);
}

}  // namespace daumier::faces
