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

/// How much of an annotation has to be there.
enum class Completeness {
  kComplete,   ///< All that Annotation promises: for the sources whose annotation is compiled into the program.
  kLandmarks,  ///< Landmarks and hairline: for user-supplied topologies. Functions that need more throw.
};

/// Crops a source's mean neutral face (cm) along the cuts (without a crop the whole mesh is kept), triangulates it by
/// the mirrored rule, traces the curves along polygon edges, fills the regions, and closes lips and eyes. Promises:
/// every curve runs along mesh edges; a mirrored curve is the mirror image vertex by vertex; UV follows its corners. If
/// complete: the mesh is its own mirror image, of one component without non-manifold edges, its holes the mouth, two
/// eyes and the neck. Otherwise: the mirror map is empty where the mesh is not its own mirror image; the region `face`
/// is all vertices unless specified; a region that is neither specified nor has its hole is absent; the face is
/// upright, looks to +z and measures 5 to 60 cm from chin to hairline.
/// @throws Error naming the annotation's entry that does not fit the mesh.
AnnotatedTemplate Annotate(const geometry::PolygonMesh& mesh, const AnnotationFile& file, const std::string& source,
                           Completeness completeness = Completeness::kComplete);

}  // namespace daumier::faces
