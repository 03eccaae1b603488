#pragma once
#include "faces/annotation_file.h"
#include "faces/face_model.h"
#include "geometry/mesh.h"

#include <functional>
#include <string>
#include <vector>

namespace daumier::faces {

/// Registered meshes of one topology, used unmodified, whereas a FaceModel draws new faces.
struct GivenFaces {
  FaceTemplate face_template;            ///< Its neutral is the mean of the neutral faces.
  std::vector<std::string> names;        ///< An identity each: "Bob/C00012".
  std::vector<std::string> groups;       ///< The real person that each identity shows; several may show the same.
  std::vector<std::string> expressions;  ///< The first is "neutral".
  /// V x 3 in cm, the vertices of the template. May be called from several threads.
  std::function<geometry::Points(int identity, int expression)> face;
};

/// The same as read from external files: whole meshes in their own units and vertex numbers.
struct GivenFiles {
  std::string source;          ///< As FaceTemplate::source.
  geometry::PolygonMesh mesh;  ///< Polygons and UV of all faces; only the number of its vertices is used.
  std::vector<std::string> names, groups, expressions;
  std::function<geometry::Points(int identity, int expression)> face;
  double cm_per_unit = 1;  ///< Used if the annotation has none.
  Json provenance;         ///< Without the checksum.
};

/// Scales to cm, averages the neutral faces, annotates their mean (Completeness::kLandmarks) and crops every face like
/// it. The checksum of the provenance is the SHA-256 over all neutral faces in their order.
/// @throws Error if there is no face, as Annotate, and as files.face.
GivenFaces ImportGivenFaces(const GivenFiles& files, const AnnotationFile& annotation);

/// The same number of vertices, all finite, and, up to the corner that a polygon begins with, the same polygons in the same order.
/// @throws Error naming `name` and what differs from `expected`.
void CheckSameTopology(const geometry::PolygonMesh& mesh, const geometry::PolygonMesh& expected,
                       const std::string& name);

}  // namespace daumier::faces
