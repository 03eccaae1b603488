#include "studio/drawn_database.h"

#include "core/error.h"
#include "core/files.h"
#include "core/manifest.h"
#include "core/safetensors.h"
#include "datasets/build/faces_plan.h"
#include "datasets/build/sketches.h"
#include "datasets/read/sketch_database.h"
#include "faces/face_database.h"
#include "render/camera_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace daumier::studio {
namespace {

namespace fs = std::filesystem;

constexpr char kDrawings[] = "drawings", kVerb[] = "studio --collect", kDrawnKind[] = "drawn";
constexpr int kViews = 2, kDrawnViews = 1;

std::vector<std::string> DrawnKinds() {
  std::vector<std::string> kinds = datasets::SketchKinds();
  kinds.push_back(kDrawnKind);
  return kinds;
}

Json EntryOf(const DrawnFace& drawing) {
  return {{"drawing", drawing.name}, {"checksum", drawing.checksum}, {"face", drawing.face}};
}

Json EntriesOf(const DrawnFaces& drawn) {
  Json entries = Json::array();
  for (const DrawnFace& drawing : drawn.drawings) entries.push_back(EntryOf(drawing));
  return entries;
}

/// The manifest that a folder has, of the same kind and of any drawings.
std::optional<Manifest> EarlierManifest(const fs::path& folder, const std::string& kind) {
  if (!fs::exists(folder / "manifest.json")) return std::nullopt;
  return ReadManifest(folder, kind);
}

/// The checksum of a shard that an earlier call wrote for this drawing.
std::optional<std::string> EarlierShard(const std::optional<Manifest>& earlier, const fs::path& folder, size_t drawing,
                                        const DrawnFace& of) {
  if (!earlier) return std::nullopt;
  const Json entries = earlier->details.value(kDrawings, Json::array());
  if (drawing >= entries.size() || entries[drawing] != EntryOf(of)) return std::nullopt;
  const std::string name = faces::PersonShardName(int(drawing));
  const auto found = earlier->checksums.find(name);
  if (found == earlier->checksums.end() || !fs::exists(folder / name)) return std::nullopt;
  return found->second;
}

void WriteFaces(const fs::path& folder, const DrawnFaces& drawn) {
  MakeDirectory(folder / "shards");
  const std::optional<Manifest> earlier = EarlierManifest(folder, "faces");
  Manifest manifest;
  manifest.kind = "faces";
  manifest.verb = kVerb;
  manifest.sources = drawn.sources;
  const size_t count = drawn.drawings.size();
  manifest.counts = {{"persons", count},
                     {"levels", 1},
                     {"expressions", 1},
                     {"faces", count},
                     {"vertices", drawn.face_template.num_vertices()}};
  std::vector<std::string> names, groups;
  for (const DrawnFace& drawing : drawn.drawings) {
    names.push_back(fmt::format("{} ({})", drawing.name, drawing.face));
    groups.push_back(drawing.group);
  }
  // The expressions of the faces are their own: the list has to begin with "neutral".
  manifest.details = {{"source", drawn.face_template.source},
                      {"gammas", {0.0}},
                      {"expressions", {"neutral"}},
                      {"names", names},
                      {"groups", groups},
                      {kDrawings, EntriesOf(drawn)}};
  manifest.checksums = faces::WriteFaceTemplate(folder, drawn.face_template);
  for (size_t i = 0; i < count; ++i) {
    const std::string name = faces::PersonShardName(int(i));
    std::optional<std::string> checksum = EarlierShard(earlier, folder, i, drawn.drawings[i]);
    if (!checksum) {
      const geometry::Points vertices = drawn.vertices(int(i));
      datasets::PersonArrays arrays;
      arrays.vertices.assign(vertices.data(), vertices.data() + vertices.size());
      checksum = datasets::WritePersonShard(folder / name, manifest, arrays);
    }
    manifest.checksums[name] = *checksum;
  }
  WriteManifest(folder, manifest);
}

/// The arrays of the sketches of a drawing: its strokes, then the exact ones (docs/formats.md).
std::string WriteSketchShardOf(const fs::path& file, const std::vector<render::Stroke>& drawn,
                               const std::vector<render::Stroke>& exact) {
  std::vector<float> points;
  std::vector<int64_t> stroke_offsets = {0}, sketch_offsets = {0};
  std::vector<int32_t> kinds;
  for (const std::vector<render::Stroke>* strokes : {&drawn, &exact}) {
    for (const render::Stroke& stroke : *strokes) {
      for (const auto& point : stroke.points) points.insert(points.end(), point.begin(), point.end());
      stroke_offsets.push_back(int64_t(points.size() / 2));
      kinds.push_back(stroke.kind);
    }
    sketch_offsets.push_back(int64_t(kinds.size()));
  }
  SafetensorsWriter writer;
  writer.SetMetadata("kind", "sketches");
  writer.Add<float>("points", {int64_t(points.size() / 2), 2}, points);
  writer.Add<int64_t>("stroke_offsets", {int64_t(stroke_offsets.size())}, stroke_offsets);
  writer.Add<int32_t>("stroke_kinds", {int64_t(kinds.size())}, kinds);
  writer.Add<int64_t>("sketch_offsets", {int64_t(sketch_offsets.size())}, sketch_offsets);
  return writer.Write(file);
}

void WriteSketches(const fs::path& folder, const fs::path& faces, const DrawnFaces& drawn) {
  MakeDirectory(folder / "shards");
  const std::optional<Manifest> earlier = EarlierManifest(folder, "sketches");
  datasets::SketchesOptions options;
  const datasets::SketchLines lines(drawn.face_template, faces::View::kFrontal, options.wrinkles);
  const render::Camera camera =
      datasets::SketchCamera(drawn.face_template, faces::View::kFrontal, options.curve_height);
  const std::vector<std::string> kinds = DrawnKinds();
  const size_t count = drawn.drawings.size();
  Manifest manifest;
  manifest.kind = "sketches";
  manifest.verb = kVerb;
  manifest.config = ToJson(options);
  manifest.config.erase("faces");
  manifest.sources = drawn.sources;
  manifest.counts = {{"persons", count},
                     {"faces", count},
                     {"faces_per_shard", 1},
                     {"views_per_face", kViews},
                     {"curves_per_sketch", lines.curves().size()},
                     {"curve_points_per_sketch", lines.num_curve_points()}};
  manifest.details = {{"version", datasets::SketchDatabase::kDrawnVersion},
                      {"drawn_views", kDrawnViews},
                      {"faces_data_hash", DataHash(faces)},
                      {"canvas", render::kSketchCanvas},
                      {"camera", render::CameraToJson(camera)},
                      {"kinds", kinds},
                      {"curves", lines.curves()},
                      {kDrawings, EntriesOf(drawn)}};
  for (size_t i = 0; i < count; ++i) {
    const std::string name = faces::PersonShardName(int(i));
    std::optional<std::string> checksum = EarlierShard(earlier, folder, i, drawn.drawings[i]);
    if (!checksum) {
      const std::vector<render::Stroke> exact = lines.Draw(drawn.vertices(int(i)), camera);
      const std::vector<render::Stroke> curves(exact.begin(), exact.begin() + std::ptrdiff_t(lines.curves().size()));
      checksum = WriteSketchShardOf(folder / name, OnCanvas(drawn.read(int(i)), curves, int(kinds.size()) - 1), exact);
    }
    manifest.checksums[name] = *checksum;
  }
  WriteManifest(folder, manifest);
}

}  // namespace

void WriteDrawnDatabase(const fs::path& folder, const DrawnFaces& drawn) {
  if (drawn.drawings.empty()) return;
  WriteFaces(folder / "faces", drawn);
  WriteSketches(folder / "sketches", folder / "faces", drawn);
}

}  // namespace daumier::studio
