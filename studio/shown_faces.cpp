#include "studio/shown_faces.h"

#include "core/error.h"
#include "core/files.h"
#include "faces/import/mesh_folder.h"
#include "reports/face_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace daumier::studio {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> MeshFilesIn(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string ending = entry.path().extension().string();
    if (entry.is_regular_file() && (ending == ".obj" || ending == ".ply") && !IsSystemFile(entry.path().filename()))
      files.push_back(entry.path());
  }
  std::ranges::sort(files);
  return files;
}

}  // namespace

ShownFaces::ShownFaces(const fs::path& folder, const std::function<faces::FaceTemplate()>& template_of_meshes) {
  if (fs::exists(folder / "manifest.json") && fs::exists(folder / "template.json")) {
    database_.emplace(folder);
    for (int face = 0; face < database_->num_faces(); ++face) ids_.push_back(fmt::format("face-{:05}", face));
    checksum_ = DataHash(folder);
    DAUMIER_CHECK(!ids_.empty(), "{}: there is no face in it", folder.string());
    return;
  }
  const std::vector<fs::path> files = MeshFilesIn(folder);
  if (files.empty())
    throw UsageError(
        fmt::format("{}: there is neither a face nor a mesh in it. Name a folder that `daumier dataset "
                    "faces` wrote, or one of meshes NAME.obj",
                    folder.string()));
  template_ = template_of_meshes();
  const Eigen::Index num_head_vertices =
      reports::HeadOf(reports::SurfaceOf(template_), template_.neutral).num_vertices();
  std::string bytes;
  for (const fs::path& file : files) {
    const std::string id = file.stem().string();
    DAUMIER_CHECK(!Find(id), "{}: two meshes have the name {}", folder.string(), id);
    geometry::Points vertices = faces::ReadMesh(file).vertices;
    const Eigen::Index num_vertices = template_.num_vertices();
    DAUMIER_CHECK(vertices.rows() == num_vertices || vertices.rows() == num_head_vertices,
                  "{}: {} vertices, expected {} of the template {}, or {} with eyes and neck. Register it with "
                  "`daumier register`",
                  file.string(), vertices.rows(), num_vertices, template_.source, num_head_vertices);
    vertices.conservativeResize(num_vertices, 3);  // What follows belongs to eyes and neck.
    bytes += id + '\n';
    bytes.append(reinterpret_cast<const char*>(vertices.data()), size_t(vertices.size()) * sizeof(*vertices.data()));
    ids_.push_back(id);
    meshes_.push_back(std::move(vertices));
  }
  checksum_ = Sha256(bytes);
}

std::optional<int> ShownFaces::Find(const std::string& id) const {
  const auto found = std::ranges::find(ids_, id);
  if (found == ids_.end()) return std::nullopt;
  return static_cast<int>(found - ids_.begin());
}

std::string ShownFaces::Describe(int face) const {
  return database_ ? database_->Describe(face) : id(face);
}

std::string ShownFaces::Group(int face) const {
  return database_ ? fmt::format("person {}", database_->group(face)) : id(face);
}

geometry::Points ShownFaces::Vertices(int face) const {
  return database_ ? database_->points(face) : meshes_.at(size_t(face));
}

const faces::FaceTemplate& ShownFaces::face_template() const {
  return database_ ? database_->face_template() : template_;
}

Json ShownFaces::sources() const {
  if (database_) return database_->manifest().sources;
  return Json::array(
      {face_template().provenance,
       {{"name", "meshes of the user"}, {"version", ""}, {"checksum", checksum_}, {"licence", "the user's own"}}});
}

}  // namespace daumier::studio
