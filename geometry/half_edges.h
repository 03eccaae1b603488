#pragma once
#include "geometry/mesh.h"

#include <OpenMesh/Core/Mesh/Traits.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

namespace daumier::geometry {

using HalfEdgeMesh = OpenMesh::TriMesh_ArrayKernelT<OpenMesh::DefaultTraitsDouble>;

/// The same vertices and triangles, in the same order, as OpenMesh half-edges; positions are taken where there are any.
/// @throws Error as CheckManifold.
HalfEdgeMesh ToHalfEdges(const Triangles& triangles, int num_vertices);
HalfEdgeMesh ToHalfEdges(const TriangleMesh& mesh);

}  // namespace daumier::geometry
