#include "faces/ict.h"

#include "core/error.h"
#include "faces/annotate.h"
#include "faces/archive.h"
#include "faces/model_shapes.h"
#include "geometry/obj.h"
#include "geometry/polygon_collector.h"
#include "geometry/submesh.h"

#include <map>
#include <numeric>
#include <optional>

namespace daumier::faces {

namespace {

constexpr int kNumIctVertices = 26719, kNumHeadVertices = 11248, kNumHeadPolygons = 11144, kNumIdentities = 100;
constexpr double kStillCm = 1e-4;  // a shape that moves no kept vertex farther than this is dropped

/// "FaceXModel/identity007.obj" -> "identity007"; empty for files that are no mesh of the model.
std::string ShapeName(const std::string& path) {
  const std::filesystem::path file(path);
  if (file.extension() != ".obj" || (file.has_parent_path() && file.parent_path().filename() != "FaceXModel"))
    return {};
  return file.stem().string();
}

/// The head's vertices and polygons; the rest is bust, teeth, eyes and the like.
geometry::PolygonMesh HeadOf(const geometry::PolygonMesh& mesh, const std::string& name) {
  DAUMIER_CHECK(mesh.vertices.rows() == kNumIctVertices, "{} has {} vertices, ICT-FaceKit Light has {}", name,
                mesh.vertices.rows(), kNumIctVertices);
  geometry::CheckFinite(mesh.vertices, name);
  std::vector<int> head(kNumHeadVertices);
  std::iota(head.begin(), head.end(), 0);
  geometry::PolygonMesh result = geometry::Submesh(mesh, geometry::MapKept(head, kNumIctVertices));
  DAUMIER_CHECK(result.num_polygons() == kNumHeadPolygons, "{}: the head has {} polygons, ICT-FaceKit Light's has {}",
                name, result.num_polygons(), kNumHeadPolygons);
  return result;
}

struct IctMeshes {
  std::optional<geometry::PolygonMesh> head;
  std::map<std::string, geometry::Points> shapes;  ///< Head vertices by shape name.
};

IctMeshes ReadMeshes(const std::filesystem::path& folder_or_archive) {
  IctMeshes meshes;
  ForEachFile(
      folder_or_archive, [](const std::string& path) { return !ShapeName(path).empty(); },
      [&](const std::string& path, std::string_view text) {
        const std::string name = (folder_or_archive / path).string(), shape = ShapeName(path);
        if (shape == "generic_neutral_mesh") {
          meshes.head = HeadOf(geometry::ParseObj(text, name), name);
        } else {
          meshes.shapes[shape] = geometry::ParseObjVertices(text, name, kNumIctVertices).topRows(kNumHeadVertices);
        }
      });
  DAUMIER_CHECK(meshes.head.has_value(), "{} holds no FaceXModel/generic_neutral_mesh.obj; is it ICT-FaceKit?",
                folder_or_archive.string());
  return meshes;
}

}  // namespace

FaceModel LoadIct(const std::filesystem::path& folder_or_archive) {
  const IctMeshes meshes = ReadMeshes(folder_or_archive);
  const AnnotatedTemplate annotated =
      Annotate(*meshes.head, ParseAnnotationFile(EmbeddedAnnotation("ict"), "ict.json"), "ict");

  FaceModel model;
  model.face_template = annotated.face_template;
  const geometry::Points& neutral = meshes.head->vertices;
  model.identity_shapes.resize(3 * model.face_template.num_vertices(), kNumIdentities);
  for (int i = 0; i < kNumIdentities; ++i) {
    const std::string name = fmt::format("identity{:03}", i);
    const auto found = meshes.shapes.find(name);
    DAUMIER_CHECK(found != meshes.shapes.end(), "{} holds no FaceXModel/{}.obj", folder_or_archive.string(), name);
    model.identity_shapes.col(i) = ShapeColumn(found->second - neutral, annotated.vertices);
    model.identity_controls.push_back(
        {.name = name, .kind = IdentityControl::Kind::kGaussian, .shapes = {i}, .sigma = 1.0});
  }

  model.numbering = {annotated.vertices.old_from_new, kNumIctVertices};
  std::vector<Eigen::VectorXf> columns;
  for (const auto& [name, points] : meshes.shapes) {
    if (name.starts_with("identity")) continue;
    Eigen::VectorXf column = ShapeColumn(points - neutral, annotated.vertices);
    if (column.cwiseAbs().maxCoeff() < kStillCm) continue;
    model.expression_shape_names.push_back(name);
    columns.push_back(std::move(column));
  }
  model.expression_shapes.resize(model.identity_shapes.rows(), columns.size());
  for (size_t e = 0; e < columns.size(); ++e) model.expression_shapes.col(e) = columns[e];
  model.expressions =
      MakeExpressions(ParseExpressionFile(EmbeddedAnnotation("ict_expressions"), "ict_expressions.json"), model);
  model.face_template.provenance = {{"name", "ICT-FaceKit Light"},
                                    {"version", "light"},
                                    {"checksum", ModelChecksum(model)},
                                    {"licence", "MIT, (c) 2020 USC Institute for Creative Technologies"}};
  return model;
}

}  // namespace daumier::faces
