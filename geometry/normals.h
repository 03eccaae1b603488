#pragma once
#include "geometry/mesh.h"

namespace daumier::geometry {

/// F x 3: (p1 - p0) x (p2 - p0), as long as twice the triangle's area, outward for counter-clockwise triangles.
Points AreaNormals(const TriangleMesh& mesh);
/// F x 3, unit length; zero for a triangle without area.
Points TriangleNormals(const TriangleMesh& mesh);
/// F, cm^2.
Eigen::VectorXd TriangleAreas(const TriangleMesh& mesh);

/// V x 3, unit length: the sum over a vertex's triangles of (a x b) / (|a|^2 |b|^2), a and b the edges at the vertex
/// [Max 1999]; exact for vertices on a sphere. Zero at vertices without a triangle that has area.
Points VertexNormals(const TriangleMesh& mesh);

/// F x 3, cm^2: the part of a triangle's area that belongs to each corner: its Voronoi region, cut off at the far side
/// where the triangle is obtuse [Rusinkiewicz 2004; Meyer et al. 2003]. A row sums to the triangle's area.
Points CornerAreas(const TriangleMesh& mesh);
/// V, cm^2: the corner areas around each vertex. They sum to the area of the surface.
Eigen::VectorXd VertexAreas(const TriangleMesh& mesh);

/// V: the area-weighted mean of the values (F) of the triangles around each vertex; 0 at vertices without area.
Eigen::VectorXd TrianglesToVertices(const TriangleMesh& mesh, const Eigen::VectorXd& values);
/// F: the mean of the values (V) of each triangle's corners.
Eigen::VectorXd VerticesToTriangles(const Triangles& triangles, const Eigen::VectorXd& values);

}  // namespace daumier::geometry
