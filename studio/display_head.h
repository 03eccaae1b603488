#pragma once
#include "core/json.h"
#include "faces/finished_head.h"
#include "render/shading.h"
#include "rig/head_interior.h"

#include <optional>
#include <string>
#include <vector>

namespace daumier::studio {

/// What the page, thumbnails and turntables show of faces of one template: their finished heads, with teeth and tongue behind the lips.
/// The first V vertices are those of the face. Thread-safe.
class DisplayHead {
 public:
  explicit DisplayHead(const faces::FaceTemplate& face_template);

  /// {num_vertices: N, num_face_vertices: V, num_triangles: T, groups: [{material, colour: [r, g, b], gloss, first, count}, ...],
  /// centre, half_height}: groups are runs of triangles, colours sRGB from 0 to 255, centre and half_height in cm.
  const Json& description() const { return description_; }
  /// T x 3 uint32, little endian: bytes that a graphics library takes as they are.
  const std::string& triangles() const { return triangles_; }
  /// N x 3 float32, little endian, cm. face: V x 3. @throws Error as faces::FinishedHead::Vertices.
  std::string Vertices(const geometry::Points& face) const;

  /// Whether a mesh is the bare surface of a face of the template: its vertices and triangles, in their order.
  bool IsBareFace(const geometry::TriangleMesh& mesh) const;
  /// The same head for drawing. @throws Error as Vertices.
  render::RenderInput Picture(const geometry::Points& face) const;

 private:
  geometry::Points PointsOf(const geometry::Points& face) const;

  geometry::Triangles face_triangles_;
  faces::FinishedHead head_;
  std::optional<rig::HeadInterior> interior_;  ///< Where there is a mouth.
  geometry::Triangles parts_;                  ///< All but skin.
  std::vector<faces::HeadMaterial> part_materials_;
  Json description_;
  std::string triangles_;
};

}  // namespace daumier::studio
