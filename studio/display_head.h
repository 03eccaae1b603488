#pragma once
#include "core/json.h"
#include "faces/finished_head.h"

#include <string>

namespace daumier::studio {

/// What the page shows of faces of one template: their finished heads, as bytes that a graphics library takes as they are.
/// The first V vertices are those of the face. Thread-safe.
class DisplayHead {
 public:
  explicit DisplayHead(const faces::FaceTemplate& face_template);

  /// {num_vertices: N, num_face_vertices: V, num_triangles: T, groups: [{material, colour: [r, g, b], gloss, first, count}, ...],
  /// centre, half_height}: groups are runs of triangles, colours sRGB from 0 to 255, centre and half_height in cm.
  const Json& description() const { return description_; }
  /// T x 3 uint32, little endian.
  const std::string& triangles() const { return triangles_; }
  /// N x 3 float32, little endian, cm. face: V x 3. @throws Error as faces::FinishedHead::Vertices.
  std::string Vertices(const geometry::Points& face) const;

 private:
  faces::FinishedHead head_;
  Json description_;
  std::string triangles_;
};

}  // namespace daumier::studio
