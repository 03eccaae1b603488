#include "cli/rig_face.h"

#include "core/error.h"
#include "core/json.h"
#include "core/weights_folder.h"
#include "eval/mesh_score.h"
#include "faces/face_database.h"
#include "faces/face_model_file.h"
#include "faces/finished_head.h"
#include "faces/import/mesh_folder.h"
#include "systems/shipped_weights.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace daumier::cli {
namespace {

namespace fs = std::filesystem;

constexpr double kLeastShareOfEdges = 0.9;  // Of a mesh, that its topology has, too.

constexpr const char* kExpected =
    "expected a mesh (.obj, .ply), an entry of a folder that `daumier predict` wrote (predicted/drawing), or a face of "
    "a "
    "database (faces/face-00012)";

GivenFace ReadFromDatabase(const fs::path& face) {
  const faces::FaceDatabase database(face.parent_path());
  const std::string name = face.filename().string();
  const auto index = eval::FaceNamed(database, name);
  if (!index)
    throw UsageError(
        fmt::format("{} has no face '{}' (expected face-00000 to face-{:05}, or "
                    "person-00000-level-1-{})",
                    face.parent_path().string(), name, database.num_faces() - 1, database.expression_names().front()));
  return {{.vertices = database.points(*index)}, face, false};
}

std::set<std::pair<int, int>> EdgesOf(const geometry::Triangles& triangles) {
  std::set<std::pair<int, int>> edges;
  for (const auto& t : triangles.rowwise())
    for (int k = 0; k < 3; ++k) edges.insert(std::minmax(t[k], t[(k + 1) % 3]));
  return edges;
}

/// The share of a mesh's edges between the face's vertices that are edges of the topology; 1 without polygons. A finished
/// head has others where its neck is cut.
double ShareOfEdges(const geometry::PolygonMesh& mesh, const faces::FaceTemplate& face_template) {
  const auto edges = EdgesOf(face_template.triangles);
  const int num_vertices = face_template.num_vertices();
  int64_t num_edges = 0, num_found = 0;
  for (int p = 0; p < mesh.num_polygons(); ++p) {
    const int begin = mesh.offsets[size_t(p)], size = mesh.offsets[size_t(p) + 1] - begin;
    for (int k = 0; k < size; ++k) {
      const int a = mesh.corners[size_t(begin + k)], b = mesh.corners[size_t(begin + (k + 1) % size)];
      if (a >= num_vertices || b >= num_vertices) continue;
      ++num_edges;
      num_found += edges.contains(std::minmax(a, b)) ? 1 : 0;
    }
  }
  return num_edges == 0 ? 1.0 : double(num_found) / double(num_edges);
}

double HeightOf(const geometry::Points& points) {
  return points.col(1).maxCoeff() - points.col(1).minCoeff();
}

/// Face models in the order in which they are tried, without those that are not installed.
class FaceModels {
 public:
  explicit FaceModels(const std::optional<faces::SourceOptions>& source) : source_(source) {
    if (source) return;
    for (const systems::ShippedWeights& weights : systems::ListWeights(systems::WeightsPlaces()))
      if (weights.system == kFaceModelSystem) shipped_.push_back(weights.directory);
  }

  /// The next one; nothing after the last.
  std::optional<faces::FaceModel> Next() {
    if (source_ && !is_source_read_) {
      is_source_read_ = true;
      return faces::LoadFaceModel(*source_);
    }
    if (next_ < shipped_.size()) return faces::ReadFaceModelWeights(shipped_[next_++]);
    if (source_ || is_source_read_) return std::nullopt;
    is_source_read_ = true;
    try {
      return faces::LoadFaceModel({});
    } catch (const Error&) {  // MakeHuman is not installed.
      tried_.emplace_back("makehuman (not installed)");
      return std::nullopt;
    }
  }

  void AddTried(const faces::FaceTemplate& face_template, int num_head_vertices) {
    const int num_vertices = face_template.num_vertices();
    tried_.push_back(
        fmt::format("{} ({} vertices{})", face_template.source, num_vertices,
                    num_head_vertices == num_vertices ? "" : fmt::format(", a head {}", num_head_vertices)));
  }
  const std::vector<std::string>& tried() const { return tried_; }

 private:
  const std::optional<faces::SourceOptions>& source_;
  std::vector<fs::path> shipped_;
  std::vector<std::string> tried_;
  size_t next_ = 0;
  bool is_source_read_ = false;
};

/// Weights of the expression that a prediction states for the mesh; empty: none.
Eigen::VectorXf StatedExpression(const fs::path& mesh, Eigen::Index num_shapes) {
  const fs::path file = mesh.parent_path() / "manifest.json";
  if (!fs::exists(file)) return {};
  const Json manifest = ReadJson(file);
  const Json::json_pointer place =
      Json::json_pointer() / "details" / "drawings" / mesh.stem().string() / "coefficients" / "expression";
  if (!manifest.is_object() || !manifest.contains(place) || !manifest.at(place).is_array()) return {};
  Eigen::VectorXf weights = Eigen::VectorXf::Zero(num_shapes);
  const Json& stated = manifest.at(place);
  for (size_t i = 0; i < std::min(stated.size(), size_t(num_shapes)); ++i)
    if (stated[i].is_number()) weights[Eigen::Index(i)] = stated[i].get<float>();
  return weights;
}

}  // namespace

GivenFace ReadGivenFace(const fs::path& face) {
  if (fs::is_directory(face)) throw UsageError(fmt::format("{} is a folder ({})", face.string(), kExpected));
  if (fs::exists(face)) return {faces::ReadMesh(face), face};
  for (const char* extension : {".obj", ".ply"}) {
    fs::path mesh = face;
    if (fs::exists(mesh += extension)) return {faces::ReadMesh(mesh), mesh};
  }
  if (fs::exists(face.parent_path() / "template.json")) return ReadFromDatabase(face);
  throw UsageError(fmt::format("there is no {} ({})", face.string(), kExpected));
}

int NumHeadVertices(const faces::FaceTemplate& face_template) {
  try {
    return faces::FinishedHead(face_template).num_vertices();
  } catch (const Error&) {
    return face_template.num_vertices();
  }
}

bool IsHeadOf(const GivenFace& given, const faces::FaceTemplate& face_template) {
  return given.is_mesh && given.mesh.num_polygons() > 0 && given.mesh.vertices.rows() > face_template.num_vertices() &&
         ShareOfEdges(given.mesh, face_template) >= kLeastShareOfEdges;
}

geometry::Points CheckedVertices(const GivenFace& given, const faces::FaceTemplate& face_template) {
  const std::string file = given.file.string();
  DAUMIER_CHECK(given.mesh.vertices.allFinite(), "{} has a vertex that is no finite number", file);
  const geometry::Points vertices = given.mesh.vertices.topRows(face_template.num_vertices());
  if (given.is_mesh)
    DAUMIER_CHECK(ShareOfEdges(given.mesh, face_template) >= kLeastShareOfEdges,
                  "{} has as many vertices as faces of '{}', but other polygons: another program has sorted its "
                  "vertices, or it is of another topology. Export it with the order of vertices kept",
                  file, face_template.source);
  constexpr double kLargestRatio = 4;
  const double ratio = HeightOf(vertices) / HeightOf(face_template.neutral);
  DAUMIER_CHECK(ratio < kLargestRatio && ratio > 1 / kLargestRatio,
                "{} is {:.3g} high, faces of '{}' are {:.0f} cm: it has another unit. Scale it to centimetres", file,
                HeightOf(vertices), face_template.source, HeightOf(face_template.neutral));
  return vertices;
}

geometry::Points ReadFaceOf(const fs::path& face, const faces::FaceTemplate& face_template, const std::string& repair) {
  const GivenFace given = ReadGivenFace(face);
  const Eigen::Index num_vertices = given.mesh.vertices.rows();
  const int expected = face_template.num_vertices();
  if (num_vertices != expected && !IsHeadOf(given, face_template) &&
      !(given.is_mesh && num_vertices == NumHeadVertices(face_template)))
    throw Error(fmt::format("{} has {} vertices, faces of this model {}: it is of another topology. {}",
                            given.file.string(), num_vertices, expected, repair));
  return CheckedVertices(given, face_template);
}

std::optional<FaceToRig> ReadFaceToRig(const GivenFace& given, const std::optional<faces::SourceOptions>& source,
                                       ShownExpression expression) {
  const Eigen::Index num_vertices = given.mesh.vertices.rows();
  FaceModels models(source);
  while (std::optional<faces::FaceModel> model = models.Next()) {
    const faces::FaceTemplate& face_template = model->face_template;
    if (num_vertices != face_template.num_vertices()) {
      const int num_head_vertices = NumHeadVertices(face_template);
      models.AddTried(face_template, num_head_vertices);
      const bool is_head = num_vertices == num_head_vertices || IsHeadOf(given, face_template);
      if (!given.is_mesh || !is_head) continue;
    }
    if (given.is_mesh && ShareOfEdges(given.mesh, face_template) < kLeastShareOfEdges) continue;
    FaceToRig result{std::move(*model), {}, given.file.stem().string(), {}};
    result.neutral = CheckedVertices(given, result.model.face_template);
    if (given.is_mesh) {
      const Eigen::VectorXf weights = StatedExpression(given.file, result.model.expression_shapes.cols());
      result.states_expression = weights.size() > 0 && !weights.isZero(0);
      if (result.states_expression && expression == ShownExpression::kRemoved) {
        const Eigen::VectorXd offset = (result.model.expression_shapes * weights).cast<double>();
        result.neutral -= Eigen::Map<const geometry::Points>(offset.data(), offset.size() / 3, 3);
        result.remarks.push_back("the expression of the prediction is removed (--keep-expression keeps it)");
      }
    }
    return result;
  }
  if (given.is_mesh) return std::nullopt;
  throw Error(
      fmt::format("{} has {} vertices, which is no topology of a face model (tried: {}). Name that of a source with "
                  "source.name=... source.path=...",
                  given.file.string(), num_vertices, fmt::join(models.tried(), "; ")));
}

faces::FaceModel ModelForForeignHeads(const std::optional<faces::SourceOptions>& source) {
  FaceModels models(source);
  std::optional<faces::FaceModel> model = models.Next();
  if (!model)
    throw UsageError(
        "there is no face model to take expressions from (expected the shipped weights/face-ict, or an installed "
        "MakeHuman: ./dev setup). Name one with source.name=... source.path=...");
  return std::move(*model);
}

}  // namespace daumier::cli
