#pragma once
#include "geometry/triangle_tree.h"

namespace daumier::datasets {

/// The translation that brings places closest to a mesh: point-to-plane steps [Chen and Medioni 1992] from a grid of
/// starts within the mesh's bounds. Least median distance.
geometry::Vector3 TranslationOnto(const geometry::TriangleMesh& mesh, const geometry::TriangleTree& tree,
                                  const geometry::Points& places);

}  // namespace daumier::datasets
