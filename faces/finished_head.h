#pragma once
#include "faces/eyeball.h"
#include "faces/face_model.h"
#include "faces/head_material.h"
#include "faces/hole_closure.h"
#include "geometry/level_cut.h"

#include <optional>
#include <vector>

namespace daumier::faces {

/// What pictures and written meshes show of a topology: heads that are closed and have eyes. A ragged neck is cut along
/// a smooth loop (CutBorder) and capped, eyeballs (EyeballFit) lie behind the lids, a bag (MouthBagPoints) behind the
/// lips. Made once for a topology; every face of it then gets the same triangles. Databases, metrics and sketches never
/// see it.
///
/// Vertices: the V of the face unchanged and in their order, also those beyond the cut, which no triangle uses; edge
/// points of the cut; the own vertices of each part. Triangles: `skin`, one closed surface with `parts` but for the
/// eyeballs; of `parts` each eye's rim of the lids and eyeball, and the mouth. The eyeballs are closed surfaces of their
/// own inside the head.
class FinishedHead {
 public:
  explicit FinishedHead(const FaceTemplate& face_template);
  /// `neutral`: V x 3; the others as in FaceTemplate. @throws Error as geometry::BoundaryLoops and EyeballFit, or if a
  /// closing triangle names no vertex.
  FinishedHead(const geometry::TriangleMesh& neutral, const geometry::Triangles& closing_triangles,
               int num_eye_closing_triangles);

  int num_face_vertices() const { return num_face_vertices_; }
  int num_vertices() const { return num_vertices_; }
  int num_eyes() const { return static_cast<int>(eyes_.size()); }

  /// Whether triangles of the neutral face are wound so that the head is a solid and not a cavity.
  bool faces_outwards() const { return faces_outwards_; }

  /// The surface: the face, then its caps.
  const geometry::Triangles& skin() const { return skin_; }
  int num_cap_triangles() const { return num_cap_triangles_; }
  /// What is behind its openings: the eyes, then the mouth.
  const geometry::Triangles& parts() const { return parts_; }
  int num_mouth_triangles() const { return num_mouth_triangles_; }
  const std::vector<HeadMaterial>& part_materials() const { return part_materials_; }  ///< One a triangle of parts().

  /// The patches that close its holes: that of the neck's cut first among `caps`; rims of lids from the right to the
  /// left, each with its eyeball's centre as apex; and that of the mouth.
  const std::vector<HoleClosure>& caps() const { return caps_; }
  std::vector<HoleClosure> rims() const;
  const std::optional<HoleClosure>& mouth() const { return mouth_; }

  /// num_vertices() x 3 for a face, V x 3, cm. A smooth function of the face. @throws Error if it has another size.
  geometry::Points Vertices(const geometry::Points& face) const;
  /// The same with eyeballs that are given, from its right to its left. @throws Error also if their number differs.
  geometry::Points Vertices(const geometry::Points& face, const std::vector<Eyeball>& eyeballs) const;
  /// The eyeballs of a face, from its right to its left.
  std::vector<Eyeball> Eyeballs(const geometry::Points& face) const;
  /// num_vertices() for values of the face's vertices, V: interpolated at edge points, NaN at the vertices of parts.
  /// @throws Error if there are not V values.
  Eigen::VectorXd Values(const Eigen::VectorXd& values) const;
  /// skin(), then parts(), as one mesh. With UV where the face has it: of caps, lids and mouth that of the hole's
  /// border, of eyeballs as EyeballUv.
  geometry::TriangleMesh Mesh(const geometry::Points& face) const;

 private:
  struct Eye {
    HoleClosure rim;  ///< Its apex is the eyeball's centre.
    EyeballFit fit;
    int first_vertex;  ///< Of the eyeball.
  };
  HoleClosure TakeClosure(std::vector<int> loop, int num_rings);
  void AddUv(const geometry::LevelCut& cut);

  int num_face_vertices_ = 0, num_vertices_ = 0, num_cap_triangles_ = 0, num_mouth_triangles_ = 0;
  bool faces_outwards_ = true;
  std::vector<geometry::EdgePoint> edge_points_;
  std::vector<HoleClosure> caps_;   ///< That of the cut first.
  geometry::Points neutral_cut_{};  ///< Its loop on the neutral face; empty without a cut.
  std::vector<Eye> eyes_;
  std::optional<HoleClosure> mouth_;
  int right_mouth_corner_ = 0, left_mouth_corner_ = 0;
  geometry::Triangles skin_, parts_;
  std::vector<HeadMaterial> part_materials_;
  geometry::TextureCoordinates uv_;
  geometry::Triangles uv_triangles_;
};

}  // namespace daumier::faces
