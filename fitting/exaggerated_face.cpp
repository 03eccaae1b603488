#include "fitting/exaggerated_face.h"

#include "fitting/mesh_code.h"

namespace daumier::fitting {

geometry::Points ExaggeratedFace(const CodeModel& model, const geometry::Points& face, double strength,
                                 std::span<const int> expression) {
  const MeshCode found = CodeOfMesh(model, face);
  Eigen::VectorXd deviation = found.code;
  for (const int number : expression) deviation[number] = 0;
  return face + model.Vertices(found.code + strength * deviation) - found.vertices;
}

}  // namespace daumier::fitting
