#pragma once
#include "rig/rigged_head.h"

#include <string>
#include <utility>
#include <vector>

namespace daumier::rig {

/// A head as closed surfaces for a printer.
struct PrintedHead {
  geometry::TriangleMesh mesh;  ///< mm, z up, the base at z = 0, its middle at x = y = 0; the face looks to -y, or up.
  int num_shells = 0;           ///< Closed surfaces, which overlap: slicers print what any of them contains.
  int num_holes = 0;            ///< That were closed, without the neck's opening.
  int num_thin = 0;             ///< Parts that were left out: sheets without thickness.
  bool faces_up = false;        ///< A mask, open at its back, lies on it.
  double volume_cm3 = 0;        ///< Sum over the shells: what overlaps counts twice.
  std::vector<std::string> warnings = {};

  geometry::Vector3 SizeMm() const {
    return (mesh.vertices.colwise().maxCoeff() - mesh.vertices.colwise().minCoeff()).transpose();
  }
};

/// Weights of targets by name.
using PrintPose = std::vector<std::pair<std::string, float>>;

/// The head with its eyes in a pose. Vertices at one place are joined. Where more than two triangles meet at an edge the
/// surface is cut, with a warning. Holes are closed by fans. Each connected part is a shell; one that is inside out is turned, one that
/// is thinner than 0.2 mm (twice its volume by its area) is left out. The largest shell gets a flat base (AddFlatBase) 2 mm below the
/// lowest point of all: its neck is extended straight down. Eyes, teeth and tongue are shells of their own, inside of the largest one or
/// overlapping it.
/// Every edge of `mesh` has two triangles in opposite directions, and every shell has a positive volume. No two vertices have the same
/// coordinates in float32 (fans that met at a place are moved apart by 0.002 mm), so that this holds for a file as well.
/// @throws Error on an unknown target, or if nothing has a thickness.
PrintedHead MakePrintedHead(const RiggedHead& head, const PrintPose& pose = {});

}  // namespace daumier::rig
