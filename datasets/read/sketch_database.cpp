#include "datasets/read/sketch_database.h"

#include "core/error.h"
#include "faces/face_database.h"
#include "render/camera_json.h"

#include <algorithm>
#include <numeric>

namespace daumier::datasets {
namespace {

/// The arrays of facts and the number of values of a sketch in each.
struct FactArray {
  const char* name;
  int64_t values;
};
constexpr FactArray kFactArrays[] = {
    {"landmarks", 2 * SketchFacts::kLandmarks},       {"hairlines", 2}, {"outlines", 2 * SketchFacts::kOutline},
    {"nose_contours", 2 * SketchFacts::kNoseContour}, {"angles", 3},    {"gaps_mm", 3}};

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
    : directory_(directory), manifest_(ReadManifest(directory, "sketches")) {
  if (checksums == Checksums::kVerify) VerifyChecksums(directory, manifest_);
  int num_persons = 0;
  try {
    num_persons = manifest_.counts.at("persons").get<int>();
    num_faces_ = manifest_.counts.at("faces").get<int>();
    faces_per_shard_ = manifest_.counts.at("faces_per_shard").get<int>();
    version_ = manifest_.details.value("version", 1);
    num_turned_views_ = manifest_.details.value("turned_views", 0);
    num_drawn_views_ = version_ == kDrawnVersion ? manifest_.details.at("drawn_views").get<int>() : 0;
    num_views_ = manifest_.counts.at("views_per_face").get<int>() - num_turned_views_;
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
  DAUMIER_CHECK(version_ >= 1 && version_ <= kDrawnVersion,
                "{}: sketches of version {}, expected 1 to {}. Read them with the version of Daumier that wrote them",
                (directory / "manifest.json").string(), version_, kDrawnVersion);
  DAUMIER_CHECK(
      version_ != kDrawnVersion || (num_drawn_views_ > 0 && num_drawn_views_ < num_views_ && num_turned_views_ == 0),
      "{}: {} of {} views are drawn and {} turned, expected some drawn, an exact one and none turned",
      (directory / "manifest.json").string(), num_drawn_views_, num_views_, num_turned_views_);
  DAUMIER_CHECK(num_persons > 0 && faces_per_shard_ > 0 && num_views_ > 0 && num_turned_views_ >= 0 &&
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
    const int64_t num_sketches =
        int64_t(num_views_ + num_turned_views_) * std::min(faces_per_shard_, num_faces_ - begin);
    CheckOffsets(path, shard, "sketch_offsets", num_sketches, num_strokes);
    CheckOffsets(path, shard, "stroke_offsets", num_strokes, shard.at("points").As<float>().size() / 2);
    if (has_facts()) CheckFacts(path, shard, num_sketches);
  }
}

void SketchDatabase::CheckFacts(const std::filesystem::path& path, const SafetensorsFile& shard,
                                int64_t num_sketches) const {
  for (const auto& [name, values] : kFactArrays) {
    const auto array = shard.at(name).As<float>();
    DAUMIER_CHECK(static_cast<int64_t>(array.size()) == num_sketches * values,
                  "{}: {} has {} values, expected {} of each of {} sketches", path.string(), name, array.size(), values,
                  num_sketches);
  }
  const size_t num_points = shard.at("points").As<float>().size() / 2;
  const size_t num_visible = shard.at("visible").As<uint8_t>().size();
  DAUMIER_CHECK(num_visible == num_points, "{}: visible has {} values, expected one of each of {} points",
                path.string(), num_visible, num_points);
}

SketchDatabase::Place SketchDatabase::Find(int face, int view) const {
  const int num_views = num_views_ + num_turned_views_;
  DAUMIER_CHECK(face >= 0 && face < num_faces_ && view >= 0 && view < num_views,
                "sketch {}, view {}, of a database of {} faces in {} views", face, view, num_faces_, num_views);
  return {&shards_[size_t(face / faces_per_shard_)], int64_t(face % faces_per_shard_) * num_views + view};
}

SketchFacts SketchDatabase::facts(int face, int view) const {
  DAUMIER_CHECK(has_facts(),
                "{}: sketches of version {}, which lack landmarks, outlines, angles and gaps; styled drawings need "
                "them. Build sketches of the faces with `daumier dataset sketches`",
                directory_.string(), version_);
  const auto [shard, row] = Find(face, view);
  const auto points_of = [&, shard = shard, row = row](const char* name, int64_t count) {
    const auto values = shard->at(name).As<float>().subspan(size_t(2 * row * count), size_t(2 * count));
    std::vector<SketchFacts::Point> points;
    for (size_t i = 0; i < values.size(); i += 2) points.push_back({values[i], values[i + 1]});
    return points;
  };
  SketchFacts facts{};
  facts.landmarks = points_of("landmarks", SketchFacts::kLandmarks);
  facts.hairline = points_of("hairlines", 1).front();
  facts.outline = points_of("outlines", SketchFacts::kOutline);
  facts.nose_contour = points_of("nose_contours", SketchFacts::kNoseContour);
  const auto angles = shard->at("angles").As<float>().subspan(size_t(3 * row), 3);
  facts.yaw = angles[0], facts.pitch = angles[1], facts.roll = angles[2];
  const auto gaps = shard->at("gaps_mm").As<float>().subspan(size_t(3 * row), 3);
  std::copy(gaps.begin(), gaps.end(), facts.gaps_mm.begin());
  const auto sketches = shard->at("sketch_offsets").As<int64_t>(), strokes = shard->at("stroke_offsets").As<int64_t>();
  const int64_t first = strokes[size_t(sketches[size_t(row)])];
  const int64_t last = strokes[size_t(sketches[size_t(row)] + num_curves_)];
  const auto visible = shard->at("visible").As<uint8_t>().subspan(size_t(first), size_t(last - first));
  facts.visible.assign(visible.begin(), visible.end());
  return facts;
}

std::vector<render::Stroke> SketchDatabase::strokes(int face, int view) const {
  const auto [place, row] = Find(face, view);
  const SafetensorsFile& shard = *place;
  const auto sketches = shard.at("sketch_offsets").As<int64_t>(), offsets = shard.at("stroke_offsets").As<int64_t>();
  const auto kinds = shard.at("stroke_kinds").As<int32_t>();
  const auto points = shard.at("points").As<float>();
  std::vector<render::Stroke> strokes;
  for (int64_t s = sketches[row]; s < sketches[row + 1]; ++s) {
    render::Stroke& stroke = strokes.emplace_back(render::Stroke{kinds[s], {}});
    for (int64_t p = offsets[s]; p < offsets[s + 1]; ++p) stroke.points.push_back({points[2 * p], points[2 * p + 1]});
  }
  return strokes;
}

std::vector<float> SketchDatabase::curve_points(int face, int view) const {
  std::vector<int> curves(static_cast<size_t>(num_curves_));
  std::iota(curves.begin(), curves.end(), 0);
  return PointsOf(strokes(face, labelled_view(view)), curves);
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
