#include "datasets/read/point_database.h"

#include "core/error.h"
#include "faces/face_database.h"

#include <algorithm>

namespace daumier::datasets {
namespace {

template <class T>
std::span<const T> Expect(const SafetensorsFile& file, const std::filesystem::path& path, const std::string& name,
                          const std::vector<int64_t>& shape) {
  const ArrayView& array = file.at(name);
  DAUMIER_CHECK(array.shape == shape && array.dtype == DtypeOf<T>(),
                "{}: {} have the shape {} or another type, expected {} of the manifest", path.string(), name,
                Json(array.shape).dump(), Json(shape).dump());
  return array.As<T>();
}

}  // namespace

PointDatabase::PointDatabase(const std::filesystem::path& directory, Checksums checksums)
    : manifest_(ReadManifest(directory, "points")) {
  if (checksums == Checksums::kVerify) VerifyChecksums(directory, manifest_);
  face_template_ = faces::ReadFaceTemplate(directory);
  int num_persons = 0;
  try {
    num_persons = manifest_.counts.at("persons").get<int>();
    num_faces_ = manifest_.counts.at("faces").get<int>();
    faces_per_shard_ = manifest_.counts.at("faces_per_shard").get<int>();
    num_samples_ = manifest_.counts.at("samples").get<int>();
    frame_ = faces::ModelFrameFromJson(manifest_.details.at("model_from_cm"));
    attribute_names_ = manifest_.details.at("attributes").get<std::vector<std::string>>();
  } catch (const Json::exception& error) {
    throw Error(fmt::format("{}: malformed: {}", (directory / "manifest.json").string(), TextOf(error)));
  }
  DAUMIER_CHECK(num_persons > 0 && faces_per_shard_ > 0 && num_samples_ >= 0 &&
                    num_faces_ >= int64_t(num_persons) * faces_per_shard_,
                "{}: {} faces of {} persons in shards of {} with {} samples", (directory / "manifest.json").string(),
                num_faces_, num_persons, faces_per_shard_, num_samples_);

  const auto open = directory / "points_template.safetensors";
  const SafetensorsFile open_file(open);
  const auto vertices = Expect<float>(open_file, open, "vertices", {num_vertices(), 3});
  template_vertices_.assign(vertices.begin(), vertices.end());
  const auto attributes = directory / "attributes.safetensors";
  Expect<float>(attributes_.emplace(attributes), attributes, "attributes",
                {num_faces_, int64_t(attribute_names_.size())});

  const auto num_triangles = static_cast<int32_t>(face_template_.triangles.rows());
  for (int begin = 0; begin < num_faces_; begin += faces_per_shard_) {
    const auto path = directory / faces::FaceShardName(num_persons, begin / faces_per_shard_);
    const int64_t count = std::min(faces_per_shard_, num_faces_ - begin);
    const SafetensorsFile& shard = shards_.emplace_back(path);
    const auto triangles = Expect<int32_t>(shard, path, "triangles", {count, num_samples_});
    Expect<float>(shard, path, "weights", {count, num_samples_, 2});
    DAUMIER_CHECK(
        std::all_of(triangles.begin(), triangles.end(), [&](int32_t t) { return t >= 0 && t < num_triangles; }),
        "{}: a sample lies in none of the {} triangles of the template", path.string(), num_triangles);
  }
}

void PointDatabase::CheckFace(int face) const {
  DAUMIER_CHECK(face >= 0 && face < num_faces_, "points of face {} of a database of {}", face, num_faces_);
}

SurfaceSamples PointDatabase::samples(int face) const {
  CheckFace(face);
  const SafetensorsFile& shard = shards_[size_t(face / faces_per_shard_)];
  const size_t row = size_t(face % faces_per_shard_), size = size_t(num_samples_);
  return {shard.at("triangles").As<int32_t>().subspan(row * size, size),
          shard.at("weights").As<float>().subspan(2 * row * size, 2 * size)};
}

std::span<const float> PointDatabase::attributes(int face) const {
  CheckFace(face);
  const size_t size = attribute_names_.size();
  return attributes_->at("attributes").As<float>().subspan(size_t(face) * size, size);
}

}  // namespace daumier::datasets
