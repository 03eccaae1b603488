#pragma once
#include "faces/annotation_file.h"
#include "faces/face_model.h"
#include "geometry/mesh.h"
#include "geometry/submesh.h"

namespace daumier::faces {

/// A template whose vertices are those of the source that the crop keeps, in the source's order.
struct AnnotatedTemplate {
  FaceTemplate face_template;    ///< Without provenance.
  geometry::VertexMap vertices;  ///< Template vertices from source vertices and back.
};

/// Crops a source's mean neutral face (cm) along the cuts, triangulates it by the mirrored rule, traces the curves
/// along polygon edges, fills the regions, and closes lips and eyes. Promises: one component without non-manifold
/// edges, its holes the mouth, two eyes and the neck; every curve runs along mesh edges; a mirrored curve is the mirror
/// image vertex by vertex.
/// @throws Error naming the annotation's entry that does not fit the mesh.
AnnotatedTemplate Annotate(const geometry::PolygonMesh& mesh, const AnnotationFile& file, const std::string& source);

}  // namespace daumier::faces
