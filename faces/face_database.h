#pragma once
#include "core/manifest.h"
#include "core/safetensors.h"
#include "faces/face_model.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace daumier::faces {

/// Which face of a database: all indices 0-based; level 0 is not exaggerated, expression 0 is neutral. Texts and
/// pictures count levels from 1 [Han et al. 2017, section 4.1: level 1 is the original shape].
struct FaceId {
  int person;
  int level;
  int expression;
  bool operator==(const FaceId&) const = default;
};

/// A folder of faces on disk: manifest.json (kind "faces"), template.safetensors, template.json, and a shard a person
/// (shards/person-00000.safetensors: `vertices` (levels, expressions, V, 3) float32 in cm, `identity_weights`, and
/// where faces were registered `distances`). Face index = (person * num_levels + level) * num_expressions + expression.
/// These are the grid. Faces that were interpolated between two of them follow
/// (shards/interpolated-00000.safetensors), as many a shard as a person has. The manifest holds counts {persons,
/// levels, expressions, faces, vertices} and details {source, gammas, expressions}, and where faces were imported also
/// {names, groups}: a name of each person, and a label that persons of the same identity share.
class FaceDatabase {
 public:
  /// Maps every shard; reads the template. @throws Error naming file and cause; a damaged shard is found by its
  /// checksum unless Checksums::kSkip.
  explicit FaceDatabase(const std::filesystem::path& directory, Checksums checksums = Checksums::kVerify);

  int num_persons() const { return num_persons_; }
  int num_levels() const { return num_levels_; }
  int num_expressions() const { return static_cast<int>(expression_names_.size()); }
  /// Faces of the grid of persons, levels and expressions: the first ones.
  int num_grid_faces() const { return num_persons_ * num_levels_ * num_expressions(); }
  int num_faces() const { return num_grid_faces() + num_interpolated_; }
  int num_vertices() const { return face_template_.num_vertices(); }

  /// @throws Error unless the face is one of the grid.
  FaceId id(int face) const;
  int index(const FaceId& id) const;
  /// Exaggeration of each level, num_levels.
  std::vector<double> gammas() const { return manifest_.details.at("gammas").get<std::vector<double>>(); }
  /// A number of each person, num_persons: equal for persons that show the same real one, 0, 1, ... in order of the
  /// first of them. Without groups in the manifest every person is its own.
  const std::vector<int>& groups() const { return groups_; }
  /// Weights of the source's identity shapes that made a person; none where faces were imported.
  std::span<const float> identity_weights(int person) const;
  /// Values of the controls that made a level of a person, one for each of control_names(); none unless levels are by controls.
  std::span<const float> control_values(int person, int level) const;
  /// Names of these, as FaceControls::value_names; none unless levels are by controls.
  std::vector<std::string> control_names() const {
    return manifest_.details.value("controls", std::vector<std::string>{});
  }
  /// The person shown, or both parents of an interpolated face.
  std::vector<int> persons(int face) const;
  /// The group of these, which is always the same one.
  int group(int face) const { return groups_[persons(face).front()]; }
  /// For people: "person 3, level 1, smile" of the person's regular face, or of an interpolated face "between persons 3 and 4".
  std::string Describe(int face) const;
  /// Vertices of a face, 3V floats (x0 y0 z0 x1 ...), mapped from disk.
  std::span<const float> vertices(int face) const;
  geometry::Points points(int face) const;
  /// Of a registered face the distance of each vertex to the mesh that it was registered onto, V, cm; NaN where the
  /// mesh has no match, so that the vertex follows its neighbours and carries no information on the mesh. Empty where
  /// faces were not registered.
  std::span<const float> match_distances(int face) const;

  const FaceTemplate& face_template() const { return face_template_; }
  const std::vector<std::string>& expression_names() const { return expression_names_; }
  const Manifest& manifest() const { return manifest_; }
  const std::filesystem::path& directory() const { return directory_; }

 private:
  std::filesystem::path directory_;
  Manifest manifest_;
  FaceTemplate face_template_;
  std::vector<std::string> expression_names_;
  int num_persons_ = 0, num_levels_ = 0, num_interpolated_ = 0;
  std::vector<int> groups_;
  std::vector<SafetensorsFile> shards_;  ///< Of the persons, then of interpolated faces.
};

/// The shard of a person inside a database's folder: shards/person-00000.safetensors.
std::string PersonShardName(int person);
/// Shard `shard` of a database: those of the persons come first, then shards/interpolated-00000.safetensors and on.
std::string FaceShardName(int num_persons, int shard);

/// Writes / reads template.safetensors and template.json in `directory`: format version 2 if the template has UV, else
/// version 1. Returns name -> checksum of the files written.
std::map<std::string, std::string> WriteFaceTemplate(const std::filesystem::path& directory,
                                                     const FaceTemplate& face_template);
/// @throws Error naming file and cause: missing, damaged, of a newer version, or indices that are not vertices.
FaceTemplate ReadFaceTemplate(const std::filesystem::path& directory);

}  // namespace daumier::faces
