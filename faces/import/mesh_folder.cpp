#include "faces/import/mesh_folder.h"

#include "core/error.h"
#include "core/files.h"
#include "core/log.h"
#include "geometry/obj.h"
#include "geometry/ply.h"

#include <algorithm>
#include <initializer_list>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>

namespace daumier::faces {

namespace {

namespace fs = std::filesystem;

std::string LowerExtension(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

/// What a file that is no OBJ or PLY is, by its extension or first bytes, and what to do with it; absent for unknown ones.
std::optional<std::string_view> OtherKind(const std::string& extension, std::string_view bytes) {
  static const std::set<std::string> drawings = {".svg", ".svgz", ".ndjson", ".png",  ".jpg",  ".jpeg", ".bmp",
                                                 ".tif", ".tiff", ".gif",    ".webp", ".heic", ".pdf"};
  static const std::set<std::string> meshes = {".stl", ".glb",  ".gltf", ".fbx", ".off", ".dae", ".3ds", ".blend",
                                               ".usd", ".usdz", ".usdc", ".x3d", ".wrl", ".vtk", ".abc", ".3mf"};
  const auto begins_with = [&](std::initializer_list<std::string_view> begins) {
    return std::any_of(begins.begin(), begins.end(), [&](std::string_view begin) { return bytes.starts_with(begin); });
  };
  if (drawings.count(extension) > 0 || begins_with({"<", "\x89PNG", "\xFF\xD8\xFF", "GIF8", "%PDF"}))
    return "a drawing or a picture (expected an OBJ or PLY mesh). `daumier predict` makes a mesh of a drawing.";
  if (meshes.count(extension) > 0 || begins_with({"glTF", "Kaydara FBX", "solid ", "OFF", "BLENDER"}))
    return "a mesh in another format (expected OBJ or PLY). Export it as one of them, for example with Blender.";
  if (begins_with({"PK\x03\x04", "\x1F\x8B", "7z\xBC\xAF", "Rar!"}))
    return "an archive (expected an OBJ or PLY mesh). Unpack it first.";
  return std::nullopt;
}

/// Paths of all meshes below a folder, relative to it, in order of name.
std::vector<fs::path> FindMeshes(const fs::path& folder) {
  DAUMIER_CHECK(fs::is_directory(folder), "{} is not a folder", folder.string());
  std::vector<fs::path> meshes;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string extension = LowerExtension(entry.path());
    if (!entry.is_regular_file() || (extension != ".obj" && extension != ".ply")) continue;
    fs::path path = fs::relative(entry.path(), folder);
    if (!IsSystemFile(path)) meshes.push_back(std::move(path));
  }
  std::sort(meshes.begin(), meshes.end());
  DAUMIER_CHECK(!meshes.empty(), "{} holds no .obj or .ply mesh", folder.string());
  return meshes;
}

GivenFiles FilesOf(const fs::path& folder, const std::vector<fs::path>& meshes, PersonOf person) {
  GivenFiles files;
  const auto mesh = std::make_shared<const geometry::PolygonMesh>(ReadMesh(folder / meshes.front()));
  files.mesh = *mesh;
  files.expressions = {"neutral"};
  for (const fs::path& path : meshes) {
    files.names.push_back(fs::path(path).replace_extension().generic_string());
    files.groups.push_back(person == PersonOf::kFile ? files.names.back() : path.parent_path().generic_string());
  }
  files.face = [mesh, folder, meshes](int identity, int) -> geometry::Points {
    const fs::path path = folder / meshes.at(identity);
    const geometry::PolygonMesh face = ReadMesh(path);
    CheckSameTopology(face, *mesh, path.string());
    return face.vertices;
  };
  return files;
}

/// The folder tMesh itself, from a folder above it.
fs::path FindTMesh(const fs::path& folder) {
  if (folder.filename() == "tMesh") return folder;
  for (const char* below : {"processedData/tMesh", "tMesh"}) {
    if (fs::is_directory(folder / below)) return folder / below;
  }
  throw Error(fmt::format("{} holds no processedData/tMesh; is it 3DCaricShop?", folder.string()));
}

/// Refuses meshes of a size with which no one can compute.
geometry::PolygonMesh CheckedSize(geometry::PolygonMesh mesh, const std::string& name) {
  constexpr double kMost = 1e30, kLeast = 1e-30;
  Eigen::RowVector3d low = Eigen::RowVector3d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const auto& vertex : mesh.vertices.rowwise()) {
    if (!vertex.allFinite()) continue;
    low = low.cwiseMin(vertex);
    high = high.cwiseMax(vertex);
  }
  if (!(low.array() <= high.array()).all()) return mesh;  // No vertex is finite.
  const double farthest = std::max(low.cwiseAbs().maxCoeff(), high.cwiseAbs().maxCoeff()),
               size = (high - low).maxCoeff();
  DAUMIER_CHECK(farthest <= kMost, "{}: has coordinates up to {:.3g}. Export it in mm, cm or m", name, farthest);
  DAUMIER_CHECK(size == 0 || size >= kLeast, "{}: is {:.3g} in size. Export it in mm, cm or m", name, size);
  return mesh;
}

}  // namespace

geometry::PolygonMesh ReadMesh(const fs::path& path) {
  const std::string name = path.string(), extension = LowerExtension(path);
  DAUMIER_CHECK(!fs::is_directory(path), "{}: a folder (expected an OBJ or PLY mesh). Name its files: {}/*.obj", name,
                path.string());
  const std::string bytes = ReadFile(path);
  constexpr std::string_view kAppleDouble("\0\x05\x16\x07", 4);
  DAUMIER_CHECK(
      !bytes.starts_with(kAppleDouble),
      "{}: what macOS keeps about a file (found AppleDouble, expected an OBJ or PLY mesh). Take the file without "
      "._ in front of its name.",
      name);
  const bool is_ply = bytes.starts_with("ply\n") || bytes.starts_with("ply\r") || bytes.starts_with("ply ");
  if (is_ply || extension == ".ply") return CheckedSize(geometry::ParsePly(bytes, name), name);
  if (const auto kind = OtherKind(extension, bytes)) throw Error(fmt::format("{}: {}", name, *kind));
  return CheckedSize(geometry::ParseObj(bytes, name), name);
}

GivenFaces LoadMeshFolder(const fs::path& folder, const AnnotationFile& annotation, PersonOf person,
                          const std::string& licence) {
  GivenFiles files = FilesOf(folder, FindMeshes(folder), person);
  files.source = "meshes";
  files.provenance = {{"name", fmt::format("{} registered meshes", files.names.size())},
                      {"version", ""},
                      {"checksum", ""},
                      {"licence", licence}};
  return ImportGivenFaces(files, annotation);
}

GivenFaces LoadCaricShop(const fs::path& folder, const AnnotationFile& annotation) {
  const fs::path root = FindTMesh(folder);
  std::map<int64_t, std::vector<fs::path>> by_size;
  size_t num_meshes = 0;
  for (const fs::path& mesh : FindMeshes(root)) {
    by_size[ReadMesh(root / mesh).vertices.rows()].push_back(mesh);
    ++num_meshes;
  }
  const auto& [num_vertices, meshes] = *std::max_element(
      by_size.begin(), by_size.end(), [](const auto& a, const auto& b) { return a.second.size() < b.second.size(); });
  if (meshes.size() < num_meshes) {
    log::Warn("{}: {} of {} meshes are skipped, since they do not have {} vertices like the others", root.string(),
              num_meshes - meshes.size(), num_meshes, num_vertices);
  }
  GivenFiles files = FilesOf(root, meshes, PersonOf::kFolder);
  files.source = "caricshop";
  files.provenance = {{"name", "3DCaricShop"},
                      {"version", "processedData/tMesh"},
                      {"checksum", ""},
                      {"licence", "3DCaricShop's terms: research only, on application; not to be passed on"}};
  return ImportGivenFaces(files, annotation);
}

}  // namespace daumier::faces
