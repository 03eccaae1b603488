#include "faces/face_database.h"

#include "core/error.h"
#include "core/files.h"
#include "geometry/corner_uv.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace daumier::faces {
namespace {

/// A template without UV is version 1, with UV version 2: files without UV keep the bytes that they always had.
constexpr int kTemplateVersion = 1, kTemplateVersionWithUv = 2;
constexpr const char* kTemplateArrays = "template.safetensors";
constexpr const char* kTemplateText = "template.json";
const std::string kRegionPrefix = "region/";

template <class Derived>
void AddMatrix(SafetensorsWriter& writer, const std::string& name, const Eigen::MatrixBase<Derived>& matrix) {
  using Scalar = typename Derived::Scalar;
  writer.Add<Scalar>(name, {matrix.rows(), matrix.cols()},
                     {matrix.derived().data(), static_cast<size_t>(matrix.size())});
}

void AddIndices(SafetensorsWriter& writer, const std::string& name, const std::vector<int>& indices) {
  writer.Add<int32_t>(name, {static_cast<int64_t>(indices.size())}, indices);
}

template <class Matrix>
Matrix ReadMatrix(const SafetensorsFile& file, const std::filesystem::path& path, const std::string& name) {
  constexpr int kColumns = Matrix::ColsAtCompileTime;
  const ArrayView& array = file.at(name);
  DAUMIER_CHECK(array.shape.size() == 2 && array.shape[1] == kColumns, "{}: array {} does not have {} columns",
                path.string(), name, kColumns);
  return Eigen::Map<const Matrix>(array.As<typename Matrix::Scalar>().data(), array.shape[0], kColumns);
}

std::vector<int> ToVector(const ArrayView& array) {
  const auto values = array.As<int32_t>();
  return {values.begin(), values.end()};
}

Json CurveToJson(const FeatureCurve& curve) {
  return {{"name", curve.name},
          {"kind", curve.kind},
          {"view", curve.view == View::kFrontal ? "frontal" : "side"},
          {"closed", curve.closed},
          {"vertices", curve.vertices}};
}

FeatureCurve CurveFromJson(const Json& json) {
  return {.name = json.at("name").get<std::string>(),
          .kind = json.at("kind").get<std::string>(),
          .view = json.at("view") == "frontal" ? View::kFrontal : View::kSide,
          .closed = json.at("closed").get<bool>(),
          .vertices = json.at("vertices").get<std::vector<int>>()};
}

/// @throws Error naming the first index that is not a vertex.
void CheckIndices(const FaceTemplate& face, const std::filesystem::path& directory) {
  const auto check = [&](const std::string& what, int index) {
    DAUMIER_CHECK(index >= 0 && index < face.num_vertices(), "{}: {} names vertex {} of a template of {} vertices",
                  directory.string(), what, index, face.num_vertices());
  };
  for (Eigen::Index i = 0; i < face.triangles.size(); ++i) check("a triangle", face.triangles.data()[i]);
  for (Eigen::Index i = 0; i < face.closing_triangles.size(); ++i) {
    check("a closing triangle", face.closing_triangles.data()[i]);
  }
  for (const int vertex : face.annotation.landmarks) check("a landmark", vertex);
  for (const int vertex : face.annotation.mirror) check("the mirror map", vertex);
  check("the hairline", face.annotation.hairline_vertex);
  for (const FeatureCurve& curve : face.annotation.curves) {
    for (const int vertex : curve.vertices) check("curve " + curve.name, vertex);
  }
  for (const auto& [name, vertices] : face.annotation.regions) {
    for (const int vertex : vertices) check("region " + name, vertex);
  }
}

/// @throws Error unless the file holds UV of every corner of the open surface.
void ReadUv(const SafetensorsFile& arrays, const std::filesystem::path& path, FaceTemplate& face) {
  face.uv = ReadMatrix<geometry::TextureCoordinates>(arrays, path, "uv");
  face.uv_triangles = ReadMatrix<geometry::Triangles>(arrays, path, "uv_triangles");
  DAUMIER_CHECK(face.has_uv(), "{}: uv is empty (expected at least one row in format version {})", path.string(),
                kTemplateVersionWithUv);
  try {
    geometry::CheckUv(SurfaceMesh(face, face.neutral));
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", path.string(), error.what()));
  }
}

/// Maps a shard whose vertices have to be there in this shape.
SafetensorsFile OpenShard(const std::filesystem::path& path, const std::vector<int64_t>& shape) {
  SafetensorsFile shard(path);
  const ArrayView& array = shard.at("vertices");
  DAUMIER_CHECK(array.shape == shape && array.dtype == Dtype::kF32,
                "{}: vertices have the shape {}, expected {} of float32 as in the manifest", path.string(),
                Json(array.shape).dump(), Json(shape).dump());
  return shard;
}

/// @throws Error if the shard holds distances to a mesh, but not one a vertex, or none at all: a failed registration.
void CheckDistances(const SafetensorsFile& shard, const std::filesystem::path& path, int num_vertices) {
  if (!shard.contains("distances")) return;
  const std::span<const float> distances = shard.at("distances").As<float>();
  DAUMIER_CHECK(distances.size() == size_t(num_vertices), "{}: {} distances of {} vertices", path.string(),
                distances.size(), num_vertices);
  const bool has_match = std::any_of(distances.begin(), distances.end(), [](float cm) { return !std::isnan(cm); });
  DAUMIER_CHECK(has_match,
                "{}: a failed registration: no vertex has a match on the mesh. Register again with `daumier register`, "
                "which leaves failed meshes out",
                path.string());
}

/// Numbers the labels of `groups` in order of their first person; without them every person is its own group.
std::vector<int> NumberGroups(const Json& details, int num_persons, const std::filesystem::path& directory) {
  std::vector<int> groups(std::max(0, num_persons));
  std::iota(groups.begin(), groups.end(), 0);
  if (!details.contains("groups")) return groups;
  const auto labels = details.at("groups").get<std::vector<std::string>>();
  DAUMIER_CHECK(labels.size() == groups.size(), "{}: its manifest lists the groups of {} persons, expected {}",
                directory.string(), labels.size(), num_persons);
  std::map<std::string, int> numbers;
  for (size_t person = 0; person < labels.size(); ++person)
    groups[person] = numbers.emplace(labels[person], static_cast<int>(numbers.size())).first->second;
  return groups;
}

}  // namespace

std::string PersonShardName(int person) {
  return fmt::format("shards/person-{:05}.safetensors", person);
}

std::string FaceShardName(int num_persons, int shard) {
  if (shard < num_persons) return PersonShardName(shard);
  return fmt::format("shards/interpolated-{:05}.safetensors", shard - num_persons);
}

std::map<std::string, std::string> WriteFaceTemplate(const std::filesystem::path& directory,
                                                     const FaceTemplate& face_template) {
  const Annotation& annotation = face_template.annotation;
  geometry::CheckUv(SurfaceMesh(face_template, face_template.neutral));
  SafetensorsWriter arrays;
  arrays.SetMetadata("kind", "face template");
  AddMatrix(arrays, "neutral", face_template.neutral);
  AddMatrix(arrays, "triangles", face_template.triangles);
  AddMatrix(arrays, "closing_triangles", face_template.closing_triangles);
  if (face_template.has_uv()) {
    AddMatrix(arrays, "uv", face_template.uv);
    AddMatrix(arrays, "uv_triangles", face_template.uv_triangles);
  }
  AddIndices(arrays, "mirror", annotation.mirror);
  for (const auto& [name, vertices] : annotation.regions) AddIndices(arrays, kRegionPrefix + name, vertices);

  Json curves = Json::array();
  for (const FeatureCurve& curve : annotation.curves) curves.push_back(CurveToJson(curve));
  const Json text = {{"format_version", face_template.has_uv() ? kTemplateVersionWithUv : kTemplateVersion},
                     {"source", face_template.source},
                     {"provenance", face_template.provenance},
                     {"num_eye_closing_triangles", face_template.num_eye_closing_triangles},
                     {"hairline_vertex", annotation.hairline_vertex},
                     {"landmarks", annotation.landmarks},
                     {"curves", curves}};
  const std::string bytes = text.dump(1) + "\n";
  WriteFileAtomically(directory / kTemplateText, bytes);
  return {{kTemplateArrays, arrays.Write(directory / kTemplateArrays)}, {kTemplateText, Sha256(bytes)}};
}

FaceTemplate ReadFaceTemplate(const std::filesystem::path& directory) {
  FaceTemplate result;
  const auto text_path = directory / kTemplateText, arrays_path = directory / kTemplateArrays;
  int version = 0;
  try {
    const Json text = ReadJson(text_path);
    version = text.at("format_version").get<int>();
    DAUMIER_CHECK(version == kTemplateVersion || version == kTemplateVersionWithUv,
                  "{}: format version {} is not supported (expected {} or {}). Read it with the program that wrote it.",
                  text_path.string(), version, kTemplateVersion, kTemplateVersionWithUv);
    result.source = text.at("source").get<std::string>();
    result.provenance = text.at("provenance");
    result.num_eye_closing_triangles = text.at("num_eye_closing_triangles").get<int>();
    result.annotation.hairline_vertex = text.at("hairline_vertex").get<int>();
    result.annotation.landmarks = text.at("landmarks").get<std::array<int, 68>>();
    for (const Json& curve : text.at("curves")) result.annotation.curves.push_back(CurveFromJson(curve));
  } catch (const Json::exception& error) {
    throw Error(fmt::format("{}: malformed: {}", text_path.string(), error.what()));
  }
  const SafetensorsFile arrays(arrays_path);
  result.neutral = ReadMatrix<geometry::Points>(arrays, arrays_path, "neutral");
  result.triangles = ReadMatrix<geometry::Triangles>(arrays, arrays_path, "triangles");
  result.closing_triangles = ReadMatrix<geometry::Triangles>(arrays, arrays_path, "closing_triangles");
  result.annotation.mirror = ToVector(arrays.at("mirror"));
  for (const auto& [name, array] : arrays.arrays()) {
    if (name.starts_with(kRegionPrefix)) {
      result.annotation.regions[name.substr(kRegionPrefix.size())] = ToVector(array);
    }
  }
  CheckIndices(result, directory);
  if (version == kTemplateVersionWithUv) ReadUv(arrays, arrays_path, result);
  return result;
}

FaceDatabase::FaceDatabase(const std::filesystem::path& directory, Checksums checksums)
    : directory_(directory), manifest_(ReadManifest(directory, "faces")) {
  if (checksums == Checksums::kVerify) VerifyChecksums(directory, manifest_);
  face_template_ = ReadFaceTemplate(directory);
  try {
    num_persons_ = manifest_.counts.at("persons").get<int>();
    num_levels_ = manifest_.counts.at("levels").get<int>();
    expression_names_ = manifest_.details.at("expressions").get<std::vector<std::string>>();
    num_interpolated_ = manifest_.counts.value("interpolated", 0);
    groups_ = NumberGroups(manifest_.details, num_persons_, directory);
  } catch (const Json::exception& error) {
    throw Error(fmt::format("{}: malformed: {}", (directory / "manifest.json").string(), error.what()));
  }
  for (int person = 0; person < num_persons_; ++person) {
    const auto path = directory / PersonShardName(person);
    shards_.push_back(OpenShard(path, {num_levels_, num_expressions(), num_vertices(), 3}));
    CheckDistances(shards_.back(), path, num_vertices());
  }
  const int per_shard = num_levels_ * num_expressions();
  for (int begin = 0; begin < num_interpolated_; begin += per_shard) {
    const auto path = directory / FaceShardName(num_persons_, num_persons_ + begin / per_shard);
    const int count = std::min(per_shard, num_interpolated_ - begin);
    const SafetensorsFile& shard = shards_.emplace_back(OpenShard(path, {count, num_vertices(), 3}));
    const auto parents = shard.at("parents").As<int32_t>();
    DAUMIER_CHECK(parents.size() == 2 * size_t(count), "{}: {} parents of {} faces", path.string(), parents.size(),
                  count);
    for (size_t i = 0; i < parents.size(); ++i) {
      DAUMIER_CHECK(parents[i] >= 0 && parents[i] < num_grid_faces(), "{}: face {} is no parent", path.string(),
                    parents[i]);
      DAUMIER_CHECK(groups_[id(parents[i]).person] == groups_[id(parents[i - i % 2]).person],
                    "{}: the parents of a face belong to different groups", path.string());
    }
  }
}

FaceId FaceDatabase::id(int face) const {
  DAUMIER_CHECK(face >= 0 && face < num_grid_faces(), "face {} is not one of the grid of {} faces", face,
                num_grid_faces());
  const int identity = face / num_expressions();
  return {identity / num_levels_, identity % num_levels_, face % num_expressions()};
}

int FaceDatabase::index(const FaceId& id) const {
  DAUMIER_CHECK(id.person >= 0 && id.person < num_persons_ && id.level >= 0 && id.level < num_levels_ &&
                    id.expression >= 0 && id.expression < num_expressions(),
                "no face of person {}, level {}, expression {} in a database of {} x {} x {}", id.person, id.level,
                id.expression, num_persons_, num_levels_, num_expressions());
  return (id.person * num_levels_ + id.level) * num_expressions() + id.expression;
}

std::span<const float> FaceDatabase::identity_weights(int person) const {
  DAUMIER_CHECK(person >= 0 && person < num_persons_, "person {} of a database of {} persons", person, num_persons_);
  const SafetensorsFile& shard = shards_[person];
  return shard.contains("identity_weights") ? shard.at("identity_weights").As<float>() : std::span<const float>();
}

std::span<const float> FaceDatabase::control_values(int person, int level) const {
  DAUMIER_CHECK(person >= 0 && person < num_persons_ && level >= 0 && level < num_levels_,
                "person {}, level {} of a database of {} persons and {} levels", person, level, num_persons_,
                num_levels_);
  const SafetensorsFile& shard = shards_[person];
  if (!shard.contains("control_values")) return {};
  const auto all = shard.at("control_values").As<float>();
  const size_t count = all.size() / num_levels_;
  return all.subspan(level * count, count);
}

std::vector<int> FaceDatabase::persons(int face) const {
  if (face < num_grid_faces()) return {id(face).person};
  const int row = face - num_grid_faces();
  DAUMIER_CHECK(row < num_interpolated_, "face {} of a database of {} faces", face, num_faces());
  const int per_shard = num_levels_ * num_expressions();
  const auto parents = shards_[num_persons_ + row / per_shard].at("parents").As<int32_t>();
  const int a = parents[2 * (row % per_shard)], b = parents[2 * (row % per_shard) + 1];
  return {id(a).person, id(b).person};
}

std::string FaceDatabase::Describe(int face) const {
  const std::vector<int> shown = persons(face);
  if (shown.size() == 2) return fmt::format("between persons {} and {}", shown[0], shown[1]);
  const FaceId where = id(face);
  return fmt::format("person {}, level {}, {}", where.person, where.level + 1, expression_names_[where.expression]);
}

std::span<const float> FaceDatabase::vertices(int face) const {
  DAUMIER_CHECK(face >= 0 && face < num_faces(), "face {} of a database of {} faces", face, num_faces());
  const size_t size = size_t(3) * num_vertices();
  const int per_shard = num_levels_ * num_expressions();
  return shards_[face / per_shard].at("vertices").As<float>().subspan(size_t(face % per_shard) * size, size);
}

geometry::Points FaceDatabase::points(int face) const {
  const auto floats = vertices(face);
  using Rows = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;
  return Eigen::Map<const Rows>(floats.data(), num_vertices(), 3).cast<double>();
}

std::span<const float> FaceDatabase::match_distances(int face) const {
  DAUMIER_CHECK(face >= 0 && face < num_faces(), "face {} of a database of {} faces", face, num_faces());
  const SafetensorsFile& shard = shards_[face / (num_levels_ * num_expressions())];
  return shard.contains("distances") ? shard.at("distances").As<float>() : std::span<const float>();
}

}  // namespace daumier::faces
