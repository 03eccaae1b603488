#include "datasets/read/sketch_database.h"

#include "core/error.h"
#include "faces/face_database.h"
#include "render/camera_json.h"

#include <algorithm>
#include <numeric>

namespace daumier::datasets {
namespace {

/// @throws Error unless the array rises from 0 to `end` in `count` steps.
void CheckOffsets(const std::filesystem::path& path, const SafetensorsFile& shard, const std::string& name,
                  int64_t count, int64_t end) {
  const auto offsets = shard.at(name).As<int64_t>();
  DAUMIER_CHECK(static_cast<int64_t>(offsets.size()) == count + 1 && offsets.front() == 0 && offsets.back() == end &&
                    std::is_sorted(offsets.begin(), offsets.end()),
                "{}: {} does not rise from 0 to {} in {} steps", path.string(), name, end, count);
}

}  // namespace

SketchDatabase::SketchDatabase(const std::filesystem::path& directory, Checksums checksums)
    : manifest_(ReadManifest(directory, "sketches")) {
  if (checksums == Checksums::kVerify) VerifyChecksums(directory, manifest_);
  int num_persons = 0;
  try {
    num_persons = manifest_.counts.at("persons").get<int>();
    num_faces_ = manifest_.counts.at("faces").get<int>();
    faces_per_shard_ = manifest_.counts.at("faces_per_shard").get<int>();
    num_views_ = manifest_.counts.at("views_per_face").get<int>();
    camera_ = render::CameraFromJson(manifest_.details.at("camera"));
    kinds_ = manifest_.details.at("kinds").get<std::vector<std::string>>();
    for (const Json& curve : manifest_.details.at("curves")) {
      if (!IsWrinkleKind(curve.at("kind").get<std::string>())) feature_curves_.push_back(num_curves_);
      curve_names_.push_back(curve.at("name"));
      ++num_curves_;
    }
  } catch (const Json::exception& error) {
    throw Error(fmt::format("{}: malformed: {}", (directory / "manifest.json").string(), TextOf(error)));
  }
  DAUMIER_CHECK(num_persons > 0 && faces_per_shard_ > 0 && num_views_ > 0 &&
                    num_faces_ >= int64_t(num_persons) * faces_per_shard_,
                "{}: {} faces of {} persons in shards of {}", (directory / "manifest.json").string(), num_faces_,
                num_persons, faces_per_shard_);
  for (int begin = 0; begin < num_faces_; begin += faces_per_shard_) {
    const auto path = directory / faces::FaceShardName(num_persons, begin / faces_per_shard_);
    const SafetensorsFile& shard = shards_.emplace_back(path);
    const auto kinds = shard.at("stroke_kinds").As<int32_t>();
    const bool kinds_are_known = std::all_of(
        kinds.begin(), kinds.end(), [this](int32_t kind) { return kind >= 0 && kind < int32_t(kinds_.size()); });
    DAUMIER_CHECK(kinds_are_known, "{}: a stroke is not of one of the {} kinds that the manifest names", path.string(),
                  kinds_.size());
    const auto num_strokes = static_cast<int64_t>(kinds.size());
    CheckOffsets(path, shard, "sketch_offsets", int64_t(num_views_) * std::min(faces_per_shard_, num_faces_ - begin),
                 num_strokes);
    CheckOffsets(path, shard, "stroke_offsets", num_strokes, shard.at("points").As<float>().size() / 2);
  }
}

std::vector<render::Stroke> SketchDatabase::strokes(int face, int view) const {
  DAUMIER_CHECK(face >= 0 && face < num_faces_ && view >= 0 && view < num_views_,
                "sketch {}, view {}, of a database of {} faces in {} views", face, view, num_faces_, num_views_);
  const SafetensorsFile& shard = shards_[face / faces_per_shard_];
  const auto sketches = shard.at("sketch_offsets").As<int64_t>(), offsets = shard.at("stroke_offsets").As<int64_t>();
  const auto kinds = shard.at("stroke_kinds").As<int32_t>();
  const auto points = shard.at("points").As<float>();
  std::vector<render::Stroke> strokes;
  const int row = face % faces_per_shard_ * num_views_ + view;
  for (int64_t s = sketches[row]; s < sketches[row + 1]; ++s) {
    render::Stroke& stroke = strokes.emplace_back(render::Stroke{kinds[s], {}});
    for (int64_t p = offsets[s]; p < offsets[s + 1]; ++p) stroke.points.push_back({points[2 * p], points[2 * p + 1]});
  }
  return strokes;
}

std::vector<float> SketchDatabase::curve_points(int face, int view) const {
  std::vector<int> curves(static_cast<size_t>(num_curves_));
  std::iota(curves.begin(), curves.end(), 0);
  return PointsOf(strokes(face, view), curves);
}

std::vector<float> PointsOf(const std::vector<render::Stroke>& strokes, std::span<const int> which) {
  std::vector<float> coordinates;
  for (const int stroke : which) {
    DAUMIER_CHECK(stroke >= 0 && stroke < static_cast<int>(strokes.size()), "stroke {} of a sketch of {}", stroke,
                  strokes.size());
    for (const auto& point : strokes[static_cast<size_t>(stroke)].points)
      coordinates.insert(coordinates.end(), point.begin(), point.end());
  }
  return coordinates;
}

bool IsWrinkleKind(const std::string& kind) {
  return kind == "wrinkle" || kind == "lips";
}

}  // namespace daumier::datasets
