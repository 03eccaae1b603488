#pragma once
#include "faces/face_model.h"
#include "faces/finished_head.h"
#include "geometry/submesh.h"
#include "rig/head_interior.h"
#include "rig/rigged_head.h"
#include "rig/texture_space.h"

#include <optional>
#include <string>
#include <vector>

namespace daumier::rig {

/// Makes rigged heads of all faces of one topology. Made once; const and thread-safe.
///
/// The mesh of a head is the finished head (faces::FinishedHead: face, cap of the neck, rims of the lids, bag of the
/// mouth) without its eyeballs and unused vertices, then teeth and tongue (HeadInterior). Skin, rims and bag are one
/// closed surface, and so are the teeth of each jaw, the tongue and the eyeballs.
class HeadRig {
 public:
  /// @throws Error as faces::FinishedHead, HeadInterior and SkinChart.
  explicit HeadRig(const faces::FaceTemplate& face_template);

  /// The atlas that all heads share. Its triangles are those of RiggedHead::mesh, then of its eyes.
  const TextureSpace& texture_space() const { return texture_space_; }
  const faces::FinishedHead& finished() const { return finished_; }
  /// The vertices of the finished head that come first in RiggedHead::mesh, ascending.
  const std::vector<int>& finished_vertices() const { return kept_.old_from_new; }

  /// `neutral`: V x 3, cm; `targets`: of its V vertices. The head has the same targets: rims, bag and cap follow the skin
  /// as a finished head's do, teeth and tongue as HeadInterior says; eyeballs have none.
  /// @throws Error if a number of vertices differs.
  /// Pivots: the head's between the ears, the jaw's where JawMotion turns jawOpen about, or as the head's if it does not.
  RiggedHead On(const geometry::Points& neutral, const MorphTargets& targets) const;

  /// The eyeballs that On() places, from the right to the left: those of faces::EyeballFit, SetBack.
  std::vector<faces::Eyeball> Eyeballs(const geometry::Points& neutral) const;

 private:
  RiggedEye EyeOf(const faces::Eyeball& eyeball, size_t side) const;
  geometry::Vector3 HeadPivot(const geometry::Points& neutral) const;
  geometry::Vector3 JawPivot(const geometry::Points& neutral, const MorphTargets& targets) const;

  std::string source_, licence_;
  std::vector<int> ears_;
  faces::FinishedHead finished_;
  std::optional<HeadInterior> interior_;  ///< Where there is a mouth.
  geometry::VertexMap kept_;
  std::vector<int> still_;  ///< Of the finished head's vertices: those of eyeballs and their centres.
  TextureSpace texture_space_;
  std::vector<faces::HeadMaterial> materials_;
  Eigen::Index num_mesh_triangles_ = 0, num_mesh_uv_ = 0, num_eye_uv_ = 0;
};

}  // namespace daumier::rig
