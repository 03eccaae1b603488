#include "datasets/build/sketches.h"

#include "core/error.h"
#include "core/safetensors.h"
#include "datasets/build/sharded_build.h"
#include "faces/face_database.h"
#include "render/strokes.h"

#include <algorithm>

namespace daumier::datasets {
namespace {

/// The frontal curves of a template, one after the other.
struct CurveLayout {
  std::vector<int> vertices;           ///< Of all points; a closed curve ends with its first vertex.
  std::vector<int64_t> offsets = {0};  ///< Into vertices, a curve each and the end.
  std::vector<int32_t> kinds;          ///< Into faces::CurveKinds().
  Json curves = Json::array();         ///< {name, kind, closed} of each, for the manifest.
};

CurveLayout FrontalCurves(const faces::FaceTemplate& face_template) {
  CurveLayout layout;
  const auto& kinds = faces::CurveKinds();
  for (const faces::FeatureCurve& curve : face_template.annotation.curves) {
    if (curve.view != faces::View::kFrontal || curve.vertices.empty()) continue;
    const auto kind = std::find(kinds.begin(), kinds.end(), curve.kind);
    DAUMIER_CHECK(kind != kinds.end(), "curve {} is of the unknown kind '{}'", curve.name, curve.kind);
    layout.vertices.insert(layout.vertices.end(), curve.vertices.begin(), curve.vertices.end());
    if (curve.closed) layout.vertices.push_back(curve.vertices.front());
    layout.offsets.push_back(static_cast<int64_t>(layout.vertices.size()));
    layout.kinds.push_back(static_cast<int32_t>(kind - kinds.begin()));
    layout.curves.push_back({{"name", curve.name}, {"kind", curve.kind}, {"closed", curve.closed}});
  }
  DAUMIER_CHECK(!layout.kinds.empty(),
                "the template of source {} has no frontal curve to draw; add 'curves' to its annotation",
                face_template.source);
  return layout;
}

geometry::Points Pick(const geometry::Points& points, const std::vector<int>& vertices) {
  return points(vertices, Eigen::all);
}

Json CameraToJson(const render::Camera& camera) {
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> rotation = camera.camera_from_world;
  return {{"camera_from_world", std::vector<double>(rotation.data(), rotation.data() + 9)},
          {"translation", std::vector<double>(camera.translation.begin(), camera.translation.end())},
          {"scale", camera.scale},
          {"principal_point", std::vector<double>(camera.principal_point.begin(), camera.principal_point.end())},
          {"width", camera.width},
          {"height", camera.height}};
}

/// The sketches of the faces from `first_face` on as arrays of a shard (docs/formats.md).
std::string WriteSketchShard(const std::filesystem::path& file, const faces::FaceDatabase& database, int first_face,
                             int num_faces, const CurveLayout& layout, const render::Camera& camera) {
  const auto num_curves = static_cast<int64_t>(layout.kinds.size());
  const auto num_points = static_cast<int64_t>(layout.vertices.size());
  std::vector<float> points;
  std::vector<int64_t> stroke_offsets = {0}, face_offsets = {0};
  std::vector<int32_t> stroke_kinds;
  points.reserve(2 * num_faces * num_points);
  for (int face = 0; face < num_faces; ++face) {
    const auto projected = render::Project(camera, Pick(database.points(first_face + face), layout.vertices));
    for (int64_t point = 0; point < num_points; ++point) {
      points.push_back(static_cast<float>(projected(point, 0)));
      points.push_back(static_cast<float>(projected(point, 1)));
    }
    for (int64_t curve = 1; curve <= num_curves; ++curve) {
      stroke_offsets.push_back(face * num_points + layout.offsets[curve]);
    }
    stroke_kinds.insert(stroke_kinds.end(), layout.kinds.begin(), layout.kinds.end());
    face_offsets.push_back((face + 1) * num_curves);
  }
  SafetensorsWriter writer;
  writer.SetMetadata("kind", "sketches");
  writer.Add<float>("points", {num_faces * num_points, 2}, points);
  writer.Add<int64_t>("stroke_offsets", {num_faces * num_curves + 1}, stroke_offsets);
  writer.Add<int32_t>("stroke_kinds", {num_faces * num_curves}, stroke_kinds);
  writer.Add<int64_t>("face_offsets", {num_faces + 1}, face_offsets);
  return writer.Write(file);
}

}  // namespace

render::Camera SketchCamera(const faces::FaceTemplate& face_template, double curve_height) {
  const geometry::Points curves = Pick(face_template.neutral, FrontalCurves(face_template).vertices);
  const Eigen::RowVector3d low = curves.colwise().minCoeff(), high = curves.colwise().maxCoeff();
  return render::FrontalCamera((low + high).transpose() / 2, (high.y() - low.y()) / 2 / curve_height,
                               render::kSketchCanvas);
}

void BuildSketches(const SketchesOptions& options, const std::filesystem::path& directory) {
  const faces::FaceDatabase database(options.faces);
  const CurveLayout layout = FrontalCurves(database.face_template());
  const render::Camera camera = SketchCamera(database.face_template(), options.curve_height);

  ShardedBuild build;
  build.manifest.kind = "sketches";
  build.manifest.verb = "dataset sketches";
  build.manifest.config = ToJson(options);
  build.manifest.config.erase("faces");
  build.manifest.seed = database.manifest().seed;
  build.manifest.sources = database.manifest().sources;
  build.manifest.counts = {{"persons", database.num_persons()},
                           {"faces", database.num_faces()},
                           {"faces_per_shard", database.num_levels() * database.num_expressions()},
                           {"strokes_per_face", layout.kinds.size()},
                           {"points_per_face", layout.vertices.size()}};
  build.manifest.details = {{"faces_data_hash", DataHash(options.faces)},
                            {"canvas", render::kSketchCanvas},
                            {"camera", CameraToJson(camera)},
                            {"kinds", faces::CurveKinds()},
                            {"curves", layout.curves}};
  const int per_shard = database.num_levels() * database.num_expressions();
  build.num_units = database.num_faces();
  build.num_shards = (database.num_faces() + per_shard - 1) / per_shard;
  build.unit = "sketches";
  build.units_per_shard = per_shard;
  build.shard_name = [num_persons = database.num_persons()](int shard) {
    return faces::FaceShardName(num_persons, shard);
  };
  build.write_shard = [&](int shard, const std::filesystem::path& file) {
    const int first = shard * per_shard;
    return WriteSketchShard(file, database, first, std::min(per_shard, database.num_faces() - first), layout, camera);
  };
  BuildShards(directory, build);
}

}  // namespace daumier::datasets
