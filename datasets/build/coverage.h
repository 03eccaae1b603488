#pragma once
#include "faces/face_database.h"

#include <vector>

namespace daumier::datasets {

/// How well the faces of one database are rebuilt from the principal components of another one's.
struct Coverage {
  int num_basis_faces = 0;        ///< Faces that the components come from: SampleFaces, at most 600.
  std::vector<int> components;    ///< 0, 10, 50, 100, 150, 200, up to the number available.
  std::vector<double> errors_mm;  ///< Of each count: mean distance of a vertex over the region `face` and all faces.
};

/// Components, means and errors are those of the coordinates of the region `face`; millimetres by the scale of `basis`.
/// Promises: the error falls with every further component; a database that is rebuilt from all its own is exact.
/// @throws Error if the templates have another number of vertices.
Coverage MeasureCoverage(const faces::FaceDatabase& basis, const faces::FaceDatabase& rebuilt);

}  // namespace daumier::datasets
