#include "datasets/build/sketches.h"

#include "core/error.h"
#include "core/safetensors.h"
#include "datasets/build/sharded_build.h"
#include "datasets/build/sketch_measures.h"
#include "datasets/read/sketch_database.h"
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
  SketchMeasures measures;
  render::Camera camera;
  int num_views;
  ViewNoise noise;
  TurnedViews turned;

  int num_all_views() const { return num_views + turned.count; }
  render::Camera CameraOf(int face, int view) const {
    if (view == 0) return camera;
    if (view >= num_views) {
      Rng rng = Stream(database.manifest().seed, fmt::format("turned view {}", view - num_views), uint64_t(face));
      return TurnedViewCamera(camera, turned, noise, rng);
    }
    Rng rng = Stream(database.manifest().seed, fmt::format("view noise {}", view), uint64_t(face));
    return NoisyCamera(camera, noise, rng);
  }
};

/// The facts of the sketches of a shard, one after the other (SketchFacts).
struct FactArrays {
  std::vector<float> landmarks, hairlines, outlines, nose_contours, angles, gaps_mm;
  std::vector<uint8_t> visible;  ///< Of all points of all strokes.

  void Add(const SketchFacts& facts, size_t num_points_in_all) {
    const auto append = [](std::vector<float>& all, const std::vector<SketchFacts::Point>& points) {
      for (const auto& point : points) all.insert(all.end(), point.begin(), point.end());
    };
    append(landmarks, facts.landmarks);
    append(hairlines, {facts.hairline});
    append(outlines, facts.outline);
    append(nose_contours, facts.nose_contour);
    angles.insert(angles.end(), {facts.yaw, facts.pitch, facts.roll});
    gaps_mm.insert(gaps_mm.end(), facts.gaps_mm.begin(), facts.gaps_mm.end());
    visible.insert(visible.end(), facts.visible.begin(), facts.visible.end());
    visible.resize(num_points_in_all, 1);  // Wrinkles are cut where they are hidden.
  }

  void AddTo(SafetensorsWriter& writer) const {
    const auto num_sketches = static_cast<int64_t>(angles.size() / 3);
    writer.Add<float>("landmarks", {num_sketches, SketchFacts::kLandmarks, 2}, landmarks);
    writer.Add<float>("hairlines", {num_sketches, 2}, hairlines);
    writer.Add<float>("outlines", {num_sketches, SketchFacts::kOutline, 2}, outlines);
    writer.Add<float>("nose_contours", {num_sketches, SketchFacts::kNoseContour, 2}, nose_contours);
    writer.Add<float>("angles", {num_sketches, 3}, angles);
    writer.Add<float>("gaps_mm", {num_sketches, 3}, gaps_mm);
    writer.Add<uint8_t>("visible", {static_cast<int64_t>(visible.size())}, visible);
  }
};

/// The sketches of the faces from `first_face` on as arrays of a shard (docs/formats.md).
std::string WriteSketchShard(const std::filesystem::path& file, const SketchPlan& plan, int first_face, int num_faces) {
  std::vector<float> points;
  std::vector<int64_t> stroke_offsets = {0}, sketch_offsets = {0};
  std::vector<int32_t> stroke_kinds;
  FactArrays facts;
  for (int face = first_face; face < first_face + num_faces; ++face) {
    const geometry::Points vertices = plan.database.points(face);
    for (int view = 0; view < plan.num_all_views(); ++view) {
      const render::Camera camera = plan.CameraOf(face, view);
      for (const render::Stroke& stroke : plan.lines.Draw(vertices, camera)) {
        for (const auto& point : stroke.points) points.insert(points.end(), point.begin(), point.end());
        stroke_offsets.push_back(static_cast<int64_t>(points.size() / 2));
        stroke_kinds.push_back(stroke.kind);
      }
      sketch_offsets.push_back(static_cast<int64_t>(stroke_kinds.size()));
      const bool is_turned = view >= plan.num_views;
      facts.Add(plan.measures.Measure(vertices, camera, is_turned ? CurveVisibility::kSeen : CurveVisibility::kAll),
                points.size() / 2);
    }
  }
  SafetensorsWriter writer;
  writer.SetMetadata("kind", "sketches");
  writer.Add<float>("points", {static_cast<int64_t>(points.size() / 2), 2}, points);
  writer.Add<int64_t>("stroke_offsets", {static_cast<int64_t>(stroke_offsets.size())}, stroke_offsets);
  writer.Add<int32_t>("stroke_kinds", {static_cast<int64_t>(stroke_kinds.size())}, stroke_kinds);
  writer.Add<int64_t>("sketch_offsets", {static_cast<int64_t>(sketch_offsets.size())}, sketch_offsets);
  facts.AddTo(writer);
  return writer.Write(file);
}

}  // namespace

void BuildSketches(const SketchesOptions& options, const std::filesystem::path& directory, const Task& task) {
  const faces::FaceDatabase database(options.faces);
  const faces::FaceTemplate& face_template = database.face_template();
  const faces::View view = options.view == "side" ? faces::View::kSide : faces::View::kFrontal;
  DAUMIER_CHECK(view == faces::View::kFrontal || options.turned.count == 0,
                "turned.count is {} of sketches from the side, expected 0: frontal sketches alone are turned",
                options.turned.count);
  SketchLines lines(face_template, view, options.wrinkles);
  SketchMeasures measures(face_template, lines.curve_vertices());
  const SketchPlan plan{
      database,          std::move(lines), std::move(measures), SketchCamera(face_template, view, options.curve_height),
      options.num_views, options.noise,    options.turned};

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
                           {"views_per_face", plan.num_all_views()},
                           {"curves_per_sketch", plan.lines.curves().size()},
                           {"curve_points_per_sketch", plan.lines.num_curve_points()}};
  build.manifest.details = {{"version", SketchDatabase::kVersion},
                            {"turned_views", plan.turned.count},
                            {"faces_data_hash", DataHash(options.faces)},
                            {"canvas", render::kSketchCanvas},
                            {"camera", render::CameraToJson(plan.camera)},
                            {"kinds", SketchKinds()},
                            {"curves", plan.lines.curves()}};
  const int per_shard = database.num_levels() * database.num_expressions();
  build.num_units = int64_t(database.num_faces()) * plan.num_all_views();
  build.num_shards = (database.num_faces() + per_shard - 1) / per_shard;
  build.unit = "sketches";
  build.units_per_shard = per_shard * plan.num_all_views();
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
