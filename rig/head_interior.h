#pragma once
#include "faces/face_model.h"
#include "faces/head_material.h"
#include "geometry/alignment.h"
#include "rig/head_charts.h"
#include "rig/morph_targets.h"

#include <string_view>
#include <vector>

namespace daumier::rig {

/// Teeth and tongue behind the lips of any face of a topology, as closed surfaces.
class HeadInterior {
 public:
  explicit HeadInterior(const faces::FaceTemplate& face_template);

  int num_vertices() const { return 0; }
  /// Their parts of the atlas, with vertices numbered from `first_vertex`.
  std::vector<ChartPiece> Charts(int) const { return {}; }
  std::vector<faces::HeadMaterial> materials() const { return {}; }
  geometry::Points Vertices(const geometry::Points&) const { return geometry::Points(0, 3); }
};

}  // namespace daumier::rig
