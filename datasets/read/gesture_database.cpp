#include "datasets/read/gesture_database.h"

#include "core/error.h"
#include "core/random.h"

#include <algorithm>

namespace daumier::datasets {
namespace {

namespace fs = std::filesystem;

template <class T>
std::span<const T> GestureArray(const SafetensorsFile& shard, const fs::path& file, const char* name,
                                const std::vector<int64_t>& shape) {
  const ArrayView& array = shard.at(name);
  DAUMIER_CHECK(array.shape == shape && array.dtype == DtypeOf<T>(), "{}: '{}' has the shape {}, expected {}",
                file.string(), name, Json(array.shape).dump(), Json(shape).dump());
  return array.As<T>();
}

/// The number of its strokes.
int CheckShard(const SafetensorsFile& shard, const fs::path& file, int num_hands) {
  const int64_t count = shard.at("gestures").size(), num_points = shard.at("points").size() / 2;
  GestureArray<float>(shard, file, "points", {num_points, 2});
  const auto offsets = GestureArray<int64_t>(shard, file, "offsets", {count + 1});
  const auto in_range = [&](const char* name, int least, int end) {
    return std::ranges::all_of(GestureArray<int32_t>(shard, file, name, {count}),
                               [&](int32_t value) { return value >= least && value < end; });
  };
  DAUMIER_CHECK(offsets.front() == 0 && offsets.back() == num_points && std::ranges::is_sorted(offsets) &&
                    in_range("gestures", 0, kNumGestures + 1) && in_range("other_strokes", -1, kNumOtherStrokeKinds) &&
                    in_range("hands", 0, num_hands),
                "{}: its numbers are no strokes of gestures. Build the folder again: daumier dataset gestures",
                file.string());
  return int(count);
}

}  // namespace

GestureDatabase::GestureDatabase(const fs::path& directory, Checksums checksums)
    : directory_(directory), manifest_(ReadManifest(directory, "gestures")) {
  if (checksums == Checksums::kVerify) VerifyChecksums(directory, manifest_);
  int num_shards = 0, num_strokes = 0;
  try {
    num_hands_ = manifest_.counts.at("hands").get<int>();
    num_shards = manifest_.counts.at("shards").get<int>();
    num_strokes = manifest_.counts.at("strokes").get<int>();
  } catch (const Json::exception& error) {
    throw Error(fmt::format("{}: malformed: {}", (directory / "manifest.json").string(), TextOf(error)));
  }
  for (int i = 0; i < num_shards; ++i) {
    const fs::path file = directory / GestureShardName(i);
    shards_.emplace_back(file);
    first_.push_back(first_.back() + CheckShard(shards_.back(), file, num_hands_));
  }
  DAUMIER_CHECK(first_.back() == num_strokes && num_strokes > 0, "{}: {} strokes, and {} in its shards",
                (directory / "manifest.json").string(), num_strokes, first_.back());
}

GestureDatabase::Place GestureDatabase::PlaceOf(int index) const {
  DAUMIER_CHECK(index >= 0 && index < num_strokes(), "stroke {} of a database of {}", index, num_strokes());
  const auto shard = size_t(std::ranges::upper_bound(first_, index) - first_.begin() - 1);
  return {shards_[shard], size_t(index - first_[shard])};
}

int GestureDatabase::hand(int index) const {
  const Place place = PlaceOf(index);
  return place.shard.at("hands").As<int32_t>()[place.row];
}

LabelledStroke GestureDatabase::stroke(int index) const {
  const auto [shard, row] = PlaceOf(index);
  const auto offsets = shard.at("offsets").As<int64_t>();
  const auto points = shard.at("points").As<float>();
  LabelledStroke stroke{.gesture = Gesture(shard.at("gestures").As<int32_t>()[row]), .hand = hand(index)};
  for (auto i = size_t(offsets[row]); i < size_t(offsets[row + 1]); ++i)
    stroke.points.emplace_back(points[2 * i], points[2 * i + 1]);
  if (const int32_t other = shard.at("other_strokes").As<int32_t>()[row]; other >= 0)
    stroke.other = OtherStrokeKind(other);
  return stroke;
}

std::string GestureShardName(int shard) {
  return fmt::format("shards/hands-{:05}.safetensors", shard);
}

std::string WriteGestureShard(const fs::path& file, const std::vector<LabelledStroke>& strokes) {
  std::vector<float> points;
  std::vector<int64_t> offsets = {0};
  std::vector<int32_t> gestures, others, hands;
  for (const LabelledStroke& stroke : strokes) {
    for (const Eigen::Vector2d& point : stroke.points) {
      points.push_back(float(point.x()));
      points.push_back(float(point.y()));
    }
    offsets.push_back(int64_t(points.size() / 2));
    gestures.push_back(int32_t(stroke.gesture));
    others.push_back(stroke.other ? int32_t(*stroke.other) : -1);
    hands.push_back(stroke.hand);
  }
  const auto count = int64_t(strokes.size());
  SafetensorsWriter writer;
  writer.SetMetadata("kind", "gestures");
  writer.Add<float>("points", {int64_t(points.size() / 2), 2}, points);
  writer.Add<int64_t>("offsets", {count + 1}, offsets);
  writer.Add<int32_t>("gestures", {count}, gestures);
  writer.Add<int32_t>("other_strokes", {count}, others);
  writer.Add<int32_t>("hands", {count}, hands);
  return writer.Write(file);
}

GestureSplit SplitByHand(const GestureDatabase& database, double validation, double test, uint64_t seed) {
  const int num_hands = database.num_hands();
  Rng rng = Stream(seed, "split of hands");
  const std::vector<int> order = rng.Permutation(num_hands);
  const int num_test = std::max(1, int(std::lround(test * num_hands)));
  const int num_validation = std::max(1, int(std::lround(validation * num_hands)));
  DAUMIER_CHECK(
      num_test + num_validation < num_hands,
      "{} hands are too few for a split with {} for validation and {} for the test. Build more (num_hands), or "
      "give smaller shares (split.validation, split.test)",
      num_hands, num_validation, num_test);
  std::vector<int> place(size_t(num_hands), 0);
  for (int i = 0; i < num_hands; ++i) place[size_t(order[size_t(i)])] = i;
  GestureSplit split;
  for (int i = 0; i < database.num_strokes(); ++i) {
    const int at = place[size_t(database.hand(i))];
    (at < num_test ? split.test : at < num_test + num_validation ? split.validation : split.train).push_back(i);
  }
  return split;
}

}  // namespace daumier::datasets
