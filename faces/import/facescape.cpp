#include "faces/import/facescape.h"

#include "core/error.h"
#include "faces/import/linear_model.h"
#include "faces/import/npy.h"

#include <cmath>

namespace daumier::faces {

FaceModel LoadFaceScape(const std::filesystem::path& path, const AnnotationFile& annotation) {
  const NumberArrays arrays = ReadNpz(path, {"shape_bm_core", "id_mean", "id_var", "fv_indices"});
  const auto array = [&](const char* name) -> const NumberArray& { return ArrayOf(arrays, name, path.string()); };
  const NumberArray& core = array("shape_bm_core");
  const auto& shape = core.shape();
  DAUMIER_CHECK(shape.size() == 3 && shape[0] > 0 && shape[0] % 3 == 0 && shape[1] > 1 && shape[2] > 0,
                "{} has the shape ({}), expected (3V, expressions, identities)", core.name(), fmt::join(shape, ", "));
  const Eigen::Index num_coordinates = shape[0], num_expressions = shape[1], num_identities = shape[2];
  const Eigen::VectorXf mean = array("id_mean").Vector(num_identities),
                        variance = array("id_var").Vector(num_identities);
  DAUMIER_CHECK((variance.array() >= 0).all(), "{}: id_var is negative", path.string());

  LinearFile file;
  file.source = "facescape";
  file.identity_shapes.resize(num_coordinates, num_identities);
  Eigen::MatrixXd faces(num_coordinates, num_expressions);  // Of the mean identity.
  int64_t at = 0;
  for (Eigen::Index m = 0; m < num_coordinates; ++m) {
    for (Eigen::Index e = 0; e < num_expressions; ++e) {
      double coordinate = 0;
      for (Eigen::Index k = 0; k < num_identities; ++k, ++at) {
        const double value = core[at];
        coordinate += value * mean[k];
        if (e == 0) file.identity_shapes(m, k) = static_cast<float>(value * std::sqrt(variance[k]));
      }
      faces(m, e) = coordinate;
    }
  }
  DAUMIER_CHECK(faces.allFinite(), "{}: an element is not finite", core.name());
  file.mean =
      array("fv_indices").Polygons(1, Eigen::Map<const geometry::Points>(faces.col(0).data(), num_coordinates / 3, 3));
  file.expression_shapes = (faces.rightCols(num_expressions - 1).colwise() - faces.col(0)).cast<float>();
  file.expression_shape_names = NumberedShapes("shape", num_expressions - 1, 1);
  file.expressions = {NeutralExpression(file.expression_shape_names.size())};
  for (size_t e = 0; e < file.expression_shape_names.size(); ++e) {
    Expression& expression = file.expressions.emplace_back(NeutralExpression(file.expression_shape_names.size()));
    expression.name = file.expression_shape_names[e];
    expression.weights[Eigen::Index(e)] = 1;
  }
  file.cm_per_unit = 0.1;
  file.provenance = {{"name", "FaceScape bilinear model"},
                     {"version", fmt::format("{} expressions, {} identities", num_expressions, num_identities)},
                     {"checksum", ""},
                     {"licence", "FaceScape's terms: non-commercial research, on application; not to be passed on"}};
  return ImportLinearModel(file, annotation);
}

}  // namespace daumier::faces
