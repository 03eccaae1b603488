#include "faces/import/given_faces.h"

#include "core/error.h"
#include "core/files.h"
#include "faces/annotate.h"
#include "geometry/polygon_collector.h"

#include <algorithm>

namespace daumier::faces {

namespace {

/// Whether two polygons of equal length are the same up to the corner they begin with.
bool SameRing(const int* a, const int* b, int size) {
  for (int shift = 0; shift < size; ++shift) {
    int k = 0;
    while (k < size && a[k] == b[(k + shift) % size]) ++k;
    if (k == size) return true;
  }
  return false;
}

}  // namespace

void CheckSameTopology(const geometry::PolygonMesh& mesh, const geometry::PolygonMesh& expected,
                       const std::string& name) {
  geometry::CheckFinite(mesh.vertices, name);
  DAUMIER_CHECK(mesh.vertices.rows() == expected.vertices.rows() && mesh.num_polygons() == expected.num_polygons(),
                "{} has {} vertices and {} polygons, the other meshes have {} and {}; all have to share one topology",
                name, mesh.vertices.rows(), mesh.num_polygons(), expected.vertices.rows(), expected.num_polygons());
  for (int p = 0; p < mesh.num_polygons(); ++p) {
    const int begin = mesh.offsets[p], size = mesh.offsets[p + 1] - begin;
    const bool is_same = begin == expected.offsets[p] && size == expected.offsets[p + 1] - begin &&
                         SameRing(&mesh.corners[begin], &expected.corners[begin], size);
    DAUMIER_CHECK(is_same,
                  "{}: polygon {} (counted from 0) differs from that of the other meshes; all have to share "
                  "one topology",
                  name, p);
  }
}

GivenFaces ImportGivenFaces(const GivenFiles& files, const AnnotationFile& annotation) {
  const int num_identities = static_cast<int>(files.names.size());
  DAUMIER_CHECK(num_identities > 0, "{}: there is no face", files.source);
  const double cm_per_unit = annotation.cm_per_unit.value_or(files.cm_per_unit);
  geometry::PolygonMesh mean = files.mesh;
  mean.vertices.setZero();
  std::string checksums;
  for (int identity = 0; identity < num_identities; ++identity) {
    const geometry::Points face = files.face(identity, 0);
    mean.vertices += face * (cm_per_unit / num_identities);
    checksums +=
        Sha256({reinterpret_cast<const char*>(face.data()), sizeof(double) * static_cast<size_t>(face.size())});
  }
  AnnotatedTemplate annotated = Annotate(mean, annotation, files.source, Completeness::kLandmarks);
  GivenFaces given{.face_template = std::move(annotated.face_template),
                   .names = files.names,
                   .groups = files.groups,
                   .expressions = files.expressions,
                   .face = [read = files.face, cm_per_unit, map = std::move(annotated.vertices)](
                               int identity, int expression) -> geometry::Points {
                     return cm_per_unit * geometry::SelectPoints(read(identity, expression), map);
                   }};
  given.face_template.provenance = files.provenance;
  given.face_template.provenance["checksum"] = Sha256(checksums);
  return given;
}

}  // namespace daumier::faces
