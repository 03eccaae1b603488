#pragma once
#include "faces/head_material.h"
#include "geometry/mesh.h"

#include <vector>

namespace daumier::faces {

/// Rings of the bag behind an open mouth (HoleClosure::num_rings).
inline constexpr int kMouthRings = 6;

/// Positions of the own vertices of a mouth bag, num_vertices() x 3. A ring is the loop of the inner lips shrunk towards
/// its centre and moved back along -z, to 0.7 times `width` at the end: straight behind the lips, where a face is
/// solid. `lips`: N x 3, cm, as geometry::BoundaryLoops orders them. `width`: between the corners of the mouth, cm.
geometry::Points MouthBagPoints(const geometry::Points& lips, double width);

/// Of each triangle of HoleClosure::Triangles with kMouthRings rings around a loop of `size` vertices: darker to the end.
std::vector<HeadMaterial> MouthBagMaterials(int size);

}  // namespace daumier::faces
