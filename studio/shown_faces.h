#pragma once
#include "core/json.h"
#include "faces/face_database.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace daumier::studio {

/// Faces that a collection shows: those of a folder that `daumier dataset faces` wrote, or the meshes NAME.obj and NAME.ply of a folder
/// (not of its sub-folders), which have the vertices of one template, or those of its
/// finished head as `daumier predict` writes it.
class ShownFaces {
 public:
  /// template_of_meshes is called for a folder of meshes alone. @throws Error as FaceDatabase and faces::ReadMesh, if a mesh has another
  /// number of vertices than its template, or if there is neither a face nor a mesh.
  ShownFaces(const std::filesystem::path& folder, const std::function<faces::FaceTemplate()>& template_of_meshes);

  int size() const { return static_cast<int>(ids_.size()); }
  /// "face-00012", or the mesh's name.
  const std::string& id(int face) const { return ids_.at(size_t(face)); }
  std::optional<int> Find(const std::string& id) const;
  /// "person 3, level 1, smile", or the mesh's name.
  std::string Describe(int face) const;
  /// Equal for faces of one person, so that a split keeps them together.
  std::string Group(int face) const;
  /// V x 3, cm.
  geometry::Points Vertices(int face) const;

  const faces::FaceTemplate& face_template() const;
  /// For manifests: where the faces come from.
  Json sources() const;
  /// Of the database, or of the meshes' names and vertices: the same faces have the same one.
  const std::string& checksum() const { return checksum_; }

 private:
  std::optional<faces::FaceDatabase> database_;
  faces::FaceTemplate template_;          ///< Of meshes.
  std::vector<geometry::Points> meshes_;  ///< In order of ids_; none of a database.
  std::vector<std::string> ids_;
  std::string checksum_;
};

}  // namespace daumier::studio
