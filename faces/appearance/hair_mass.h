#pragma once
#include "faces/appearance/looks.h"
#include "faces/appearance/scalp.h"
#include "faces/face_model.h"

#include <string>

namespace daumier::faces {

/// Hair as a surface of its own.
struct HairMass {
  geometry::TriangleMesh mesh;  ///< cm, in the face's frame, without UV; closed parts. Empty: bald.
  Eigen::MatrixXf colours;      ///< N x 3, a vertex a row, RGB in [0, 1].
};

/// Makes the hair of portraits (AddHair) for faces of one topology. Const and thread-safe.
class HairMaker {
 public:
  /// @throws Error as Scalp.
  explicit HairMaker(const FaceTemplate& face_template);

  /// face: V x 3, cm; `looks`: hair, hair_colour, hair_volume, hair_length, hair_fringe, hair_parting and detail_seed
  /// count. Deterministic.
  HairMass Make(const geometry::Points& face, const Looks& looks) const;

 private:
  Scalp scalp_;
};

/// @throws Error listing kHairStyleNames if there is none of that name.
HairStyle HairStyleNamed(const std::string& name);

}  // namespace daumier::faces
