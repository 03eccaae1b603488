#pragma once
#include "core/picture_parts.h"
#include "faces/appearance/albedo_basis.h"
#include "faces/appearance/looks.h"
#include "faces/finished_head.h"
#include "geometry/mesh.h"

#include <Eigen/Core>

#include <cstdint>
#include <memory>
#include <vector>

namespace daumier::faces {

/// Everything that a portrait shows of one face, as one list of triangles. Vertices are repeated where colours break.
/// All but the face's own surface are closed or seen from both sides.
struct PortraitHead {
  geometry::Points vertices;      ///< N x 3, cm; the first V are the face's, unchanged.
  geometry::Triangles triangles;  ///< T x 3, counter-clockwise seen from outside.
  Eigen::MatrixXf colours;        ///< N x 3, albedo, RGB in [0, 1].
  std::vector<uint8_t> classes;   ///< T: PictureClass.
  std::vector<uint8_t> parts;     ///< T: PicturePart.
};

/// What dresses faces of one topology; made once. Const and thread-safe.
class HeadDresser {
 public:
  /// @throws Error as FinishedHead and MakeAlbedoBasis, or if the template has no region `face`.
  explicit HeadDresser(const FaceTemplate& face_template);
  ~HeadDresser();
  HeadDresser(HeadDresser&&) noexcept;
  HeadDresser& operator=(HeadDresser&&) noexcept;

  const FaceTemplate& face_template() const;
  const FinishedHead& finished() const;
  const AlbedoBasis& albedo() const;

  /// The face (V x 3, cm) with skin colours, eyes, brows, lashes, teeth, hair, beard, hat, glasses, neck and shoulders. Deterministic.
  /// All parts are functions of the vertices, so that they fit every face of the topology.
  /// @throws Error if the face has another number of vertices or the looks another number of albedo coefficients.
  PortraitHead Dress(const geometry::Points& face, const Looks& looks) const;

 private:
  struct Parts;
  std::unique_ptr<const Parts> parts_;
};

inline PortraitHead DressHead(const HeadDresser& dresser, const geometry::Points& face, const Looks& looks) {
  return dresser.Dress(face, looks);
}

}  // namespace daumier::faces
