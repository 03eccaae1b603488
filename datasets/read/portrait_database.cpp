#include "datasets/read/portrait_database.h"

#include "core/error.h"
#include "faces/face_database.h"

#include <algorithm>
#include <cmath>

namespace daumier::datasets {
namespace {

constexpr double kVertexStep = 0.001;  // cm

struct RowArray {
  const char* name;
  std::vector<int64_t> row;  ///< Shape of what an image has of it.
  Dtype dtype;
};

std::vector<RowArray> RowArrays(bool has_vertices, int num_vertices) {
  std::vector<RowArray> arrays = {{"landmarks", {PortraitSizes::kLandmarks, 2}, Dtype::kF32},
                                  {"visibility", {PortraitSizes::kLandmarks}, Dtype::kU8},
                                  {"states", {3}, Dtype::kF32},
                                  {"expression", {PortraitSizes::kExpression}, Dtype::kF32},
                                  {"albedo", {PortraitSizes::kAlbedo}, Dtype::kF32},
                                  {"light", {PortraitSizes::kLight}, Dtype::kF32},
                                  {"pose", {PortraitSizes::kPose}, Dtype::kF32},
                                  {"faces", {}, Dtype::kI32},
                                  {"persons", {}, Dtype::kI32},
                                  {"styles", {}, Dtype::kI32},
                                  {"skin_tones", {}, Dtype::kI32},
                                  {"bald", {}, Dtype::kU8},
                                  {"eye_sizes", {}, Dtype::kF32}};
  if (has_vertices) arrays.push_back({"vertices", {num_vertices, 3, 2}, Dtype::kU8});
  return arrays;
}

/// @throws Error unless all numbers of an array are in [low, high] and finite.
template <class T>
void CheckValues(const std::filesystem::path& path, const SafetensorsFile& shard, const char* name, double low,
                 double high) {
  for (const T value : shard.at(name).As<T>()) {
    DAUMIER_CHECK(double(value) >= low && double(value) <= high, "{}: {} holds {}, expected {} to {}", path.string(),
                  name, value, low, high);
  }
}

void CheckFiniteValues(const std::filesystem::path& path, const SafetensorsFile& shard, const char* name) {
  for (const float value : shard.at(name).As<float>())
    DAUMIER_CHECK(std::isfinite(value), "{}: {} holds a number that is not finite", path.string(), name);
}

/// The number of images. @throws Error unless the offsets rise from 0 to the number of bytes.
int64_t CountFiles(const std::filesystem::path& path, const SafetensorsFile& shard, const std::string& bytes,
                   const std::string& offsets) {
  const auto values = shard.at(offsets).As<int64_t>();
  const auto size = static_cast<int64_t>(shard.at(bytes).As<uint8_t>().size());
  DAUMIER_CHECK(
      !values.empty() && values.front() == 0 && values.back() == size && std::is_sorted(values.begin(), values.end()),
      "{}: {} does not rise from 0 to {}", path.string(), offsets, size);
  return static_cast<int64_t>(values.size()) - 1;
}

}  // namespace

std::string PortraitShardName(int shard) {
  return fmt::format("shards/portraits-{:05}.safetensors", shard);
}

PortraitDatabase::PortraitDatabase(const std::filesystem::path& directory, Checksums checksums)
    : directory_(directory), manifest_(ReadManifest(directory, "portraits")) {
  if (checksums == Checksums::kVerify) VerifyChecksums(directory, manifest_);
  const auto manifest_path = directory / "manifest.json";
  int num_images = 0, num_shards = 0;
  try {
    num_images = manifest_.counts.at("images").get<int>();
    num_shards = manifest_.counts.at("shards").get<int>();
    const Json& details = manifest_.details;
    if (details.value("known_faces", true)) face_template_ = faces::ReadFaceTemplate(directory);
    image_size_ = details.at("size").get<int>();
    focal_ = details.at("focal").get<double>();
    distance_ = details.at("distance").get<double>();
    const auto centre = details.at("centre").get<std::array<double, 3>>();
    centre_ = geometry::Vector3(centre[0], centre[1], centre[2]);
    has_vertices_ = details.at("vertices").get<bool>();
    expression_names_ = details.at("expressions").get<std::vector<std::string>>();
    style_names_ = details.at("styles").get<std::vector<std::string>>();
  } catch (const Json::exception& error) {
    throw Error(fmt::format("{}: malformed: {}", manifest_path.string(), TextOf(error)));
  }
  DAUMIER_CHECK(num_images > 0 && num_shards > 0 && num_shards <= num_images && image_size_ > 0 && focal_ > 0 &&
                    distance_ > 0 && expression_names_.size() <= size_t(PortraitSizes::kExpression),
                "{}: {} images of {} pixels in {} shards, {} expressions, focal length {}, distance {}",
                manifest_path.string(), num_images, image_size_, num_shards, expression_names_.size(), focal_,
                distance_);
  DAUMIER_CHECK(has_known_faces() || !has_vertices_, "{}: has vertices of faces that are not known",
                manifest_path.string());
  const std::vector<RowArray> arrays = RowArrays(has_vertices_, face_template_.num_vertices());
  for (int s = 0; s < num_shards; ++s) {
    const auto path = directory / PortraitShardName(s);
    const SafetensorsFile& shard = shards_.emplace_back(path);
    const int64_t count = CountFiles(path, shard, "pictures", "picture_offsets");
    DAUMIER_CHECK(CountFiles(path, shard, "masks", "mask_offsets") == count, "{}: not as many masks as pictures",
                  path.string());
    for (const RowArray& array : arrays) {
      std::vector<int64_t> shape = {count};
      shape.insert(shape.end(), array.row.begin(), array.row.end());
      const ArrayView& view = shard.at(array.name);
      DAUMIER_CHECK(view.shape == shape && view.dtype == array.dtype, "{}: {} has the shape {}, expected {}",
                    path.string(), array.name, Json(view.shape).dump(), Json(shape).dump());
      if (array.dtype == Dtype::kF32) CheckFiniteValues(path, shard, array.name);
    }
    constexpr double kAnyIndex = 2147483647;
    CheckValues<uint8_t>(path, shard, "visibility", 0, 1);
    CheckValues<uint8_t>(path, shard, "bald", 0, 1);
    CheckValues<int32_t>(path, shard, "styles", 0, double(style_names_.size()) - 1);
    CheckValues<int32_t>(path, shard, "skin_tones", 0, 5);
    CheckValues<int32_t>(path, shard, "faces", 0, kAnyIndex);
    CheckValues<int32_t>(path, shard, "persons", 0, kAnyIndex);
    first_.push_back(first_.back() + static_cast<int>(count));
  }
  DAUMIER_CHECK(first_.back() == num_images, "{}: its shards hold {} images, expected {}", manifest_path.string(),
                first_.back(), num_images);
}

std::pair<const SafetensorsFile*, int> PortraitDatabase::Find(int i) const {
  DAUMIER_CHECK(i >= 0 && i < size(), "portrait {} of a database of {}", i, size());
  const auto next = std::upper_bound(first_.begin(), first_.end(), i);
  const auto shard = static_cast<size_t>(next - first_.begin()) - 1;
  return {&shards_[shard], i - first_[shard]};
}

template <class T>
std::span<const T> PortraitDatabase::Row(int i, const char* array, int count) const {
  const auto [shard, row] = Find(i);
  return shard->at(array).As<T>().subspan(size_t(row) * count, count);
}

render::Image PortraitDatabase::Decode(int i, const std::string& bytes, const std::string& offsets,
                                       int channels) const {
  const auto [shard, row] = Find(i);
  const auto ends = shard->at(offsets).As<int64_t>();
  const auto all = shard->at(bytes).As<uint8_t>();
  const std::string name = fmt::format("{}: {} of portrait {}", directory_.string(), bytes, i);
  render::Image image = render::DecodeImage(
      {reinterpret_cast<const char*>(all.data()) + ends[row], size_t(ends[row + 1] - ends[row])}, name);
  DAUMIER_CHECK(image.height == image_size_ && image.width == image_size_ && image.channels == channels,
                "{}: {} x {} x {}, expected {} x {} x {}", name, image.height, image.width, image.channels, image_size_,
                image_size_, channels);
  return image;
}

render::Image PortraitDatabase::picture(int i) const {
  return Decode(i, "pictures", "picture_offsets", 3);
}

render::Image PortraitDatabase::mask(int i) const {
  render::Image mask = Decode(i, "masks", "mask_offsets", 1);
  const bool is_known =
      std::all_of(mask.pixels.begin(), mask.pixels.end(), [](uint8_t value) { return value < kNumPictureClasses; });
  DAUMIER_CHECK(is_known, "{}: the mask of portrait {} holds a class that is not there", directory_.string(), i);
  return mask;
}

std::vector<float> PortraitDatabase::landmarks(int i) const {
  const auto row = Row<float>(i, "landmarks", 2 * PortraitSizes::kLandmarks);
  return {row.begin(), row.end()};
}

std::vector<uint8_t> PortraitDatabase::visibility(int i) const {
  const auto row = Row<uint8_t>(i, "visibility", PortraitSizes::kLandmarks);
  return {row.begin(), row.end()};
}

std::span<const float> PortraitDatabase::expression(int i) const {
  return Row<float>(i, "expression", PortraitSizes::kExpression);
}
std::span<const float> PortraitDatabase::albedo(int i) const {
  return Row<float>(i, "albedo", PortraitSizes::kAlbedo);
}
std::span<const float> PortraitDatabase::light(int i) const {
  return Row<float>(i, "light", PortraitSizes::kLight);
}
std::span<const float> PortraitDatabase::pose(int i) const {
  return Row<float>(i, "pose", PortraitSizes::kPose);
}

int PortraitDatabase::face(int i) const {
  return Row<int32_t>(i, "faces", 1)[0];
}
int PortraitDatabase::person(int i) const {
  return Row<int32_t>(i, "persons", 1)[0];
}

float PortraitDatabase::eye_size(int i) const {
  return Row<float>(i, "eye_sizes", 1)[0];
}

geometry::Points PortraitDatabase::vertices(int i) const {
  DAUMIER_CHECK(has_vertices_, "{}: it was built without vertices; build it with vertices=true", directory_.string());
  geometry::Points points(face_template_.num_vertices(), 3);
  const auto bytes = Row<uint8_t>(i, "vertices", static_cast<int>(2 * points.size()));
  for (Eigen::Index k = 0; k < points.size(); ++k) {
    const auto step = static_cast<int16_t>(uint16_t(bytes[2 * k] | bytes[2 * k + 1] << 8));
    points.data()[k] = kVertexStep * step;
  }
  return points;
}

std::string PortraitDatabase::style(int i) const {
  return style_names_[size_t(Row<int32_t>(i, "styles", 1)[0])];
}
bool PortraitDatabase::is_bald(int i) const {
  return Row<uint8_t>(i, "bald", 1)[0] != 0;
}
std::array<float, 3> PortraitDatabase::states(int i) const {
  const auto row = Row<float>(i, "states", 3);
  return {row[0], row[1], row[2]};
}
int PortraitDatabase::skin_tone(int i) const {
  return Row<int32_t>(i, "skin_tones", 1)[0];
}

}  // namespace daumier::datasets
