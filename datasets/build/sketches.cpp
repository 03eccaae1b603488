#include "datasets/build/sketches.h"

#include "core/error.h"
#include "core/safetensors.h"
#include "datasets/build/sharded_build.h"
#include "faces/face_database.h"
#include "render/camera_json.h"
#include "render/strokes.h"

#include <algorithm>

namespace daumier::datasets {
namespace {

/// All that the sketches of a database have in common.
struct SketchPlan {
  const faces::FaceDatabase& database;
  SketchLines lines;
  render::Camera camera;
  int num_views;
  ViewNoise noise;

  render::Camera CameraOf(int face, int view) const {
    if (view == 0) return camera;
    Rng rng = Stream(database.manifest().seed, fmt::format("view noise {}", view), uint64_t(face));
    return NoisyCamera(camera, noise, rng);
  }
};

/// The sketches of the faces from `first_face` on as arrays of a shard (docs/formats.md).
std::string WriteSketchShard(const std::filesystem::path& file, const SketchPlan& plan, int first_face, int num_faces) {
  std::vector<float> points;
  std::vector<int64_t> stroke_offsets = {0}, sketch_offsets = {0};
  std::vector<int32_t> stroke_kinds;
  for (int face = first_face; face < first_face + num_faces; ++face) {
    const geometry::Points vertices = plan.database.points(face);
    for (int view = 0; view < plan.num_views; ++view) {
      for (const render::Stroke& stroke : plan.lines.Draw(vertices, plan.CameraOf(face, view))) {
        for (const auto& point : stroke.points) points.insert(points.end(), point.begin(), point.end());
        stroke_offsets.push_back(static_cast<int64_t>(points.size() / 2));
        stroke_kinds.push_back(stroke.kind);
      }
      sketch_offsets.push_back(static_cast<int64_t>(stroke_kinds.size()));
    }
  }
  SafetensorsWriter writer;
  writer.SetMetadata("kind", "sketches");
  writer.Add<float>("points", {static_cast<int64_t>(points.size() / 2), 2}, points);
  writer.Add<int64_t>("stroke_offsets", {static_cast<int64_t>(stroke_offsets.size())}, stroke_offsets);
  writer.Add<int32_t>("stroke_kinds", {static_cast<int64_t>(stroke_kinds.size())}, stroke_kinds);
  writer.Add<int64_t>("sketch_offsets", {static_cast<int64_t>(sketch_offsets.size())}, sketch_offsets);
  return writer.Write(file);
}

}  // namespace

void BuildSketches(const SketchesOptions& options, const std::filesystem::path& directory, const Task& task) {
  const faces::FaceDatabase database(options.faces);
  const faces::FaceTemplate& face_template = database.face_template();
  const faces::View view = options.view == "side" ? faces::View::kSide : faces::View::kFrontal;
  const SketchPlan plan{database, SketchLines(face_template, view, options.wrinkles),
                        SketchCamera(face_template, view, options.curve_height), options.num_views, options.noise};

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
                           {"views_per_face", plan.num_views},
                           {"curves_per_sketch", plan.lines.curves().size()},
                           {"curve_points_per_sketch", plan.lines.num_curve_points()}};
  build.manifest.details = {{"faces_data_hash", DataHash(options.faces)},
                            {"canvas", render::kSketchCanvas},
                            {"camera", render::CameraToJson(plan.camera)},
                            {"kinds", SketchKinds()},
                            {"curves", plan.lines.curves()}};
  const int per_shard = database.num_levels() * database.num_expressions();
  build.num_units = int64_t(database.num_faces()) * plan.num_views;
  build.num_shards = (database.num_faces() + per_shard - 1) / per_shard;
  build.unit = "sketches";
  build.units_per_shard = per_shard * plan.num_views;
  build.shard_name = [num_persons = database.num_persons()](int shard) {
    return faces::FaceShardName(num_persons, shard);
  };
  build.write_shard = [&](int shard, const std::filesystem::path& file) {
    const int first = shard * per_shard;
    return WriteSketchShard(file, plan, first, std::min(per_shard, database.num_faces() - first));
  };
  BuildShards(directory, build, task);
}

}  // namespace daumier::datasets
