#include "fitting/mesh_code.h"

#include "tests/support/expect_error.h"
#include "tests/support/field_model.h"

#include <gtest/gtest.h>

#include <limits>

namespace daumier::testing {
namespace {

Eigen::VectorXd SomeMeshCode() {
  Eigen::VectorXd code(FieldModel::kFields);
  code << 0.6, -0.5, 0.3, 1.2, -0.7, 0.4;
  return code;
}

TEST(MeshCode, FindsTheCodeOfAFaceOfTheModel) {
  for (const double bend : {0.0, 0.3}) {
    const FieldModel model(bend);
    const fitting::MeshCode found = fitting::CodeOfMesh(model, model.Vertices(SomeMeshCode()), {.ridge = 1e-8});
    EXPECT_LT((found.code - SomeMeshCode()).norm(), 1e-3) << bend;
    EXPECT_LT(found.mean_error_cm, 1e-3) << bend;
    for (size_t i = 1; i < found.energies.size(); ++i) EXPECT_LT(found.energies[i], found.energies[i - 1]);
  }
}

TEST(MeshCode, SampledPointsGiveAboutTheCodeOfAllPoints) {
  const FieldModel model;
  const geometry::Points face = model.Vertices(SomeMeshCode());
  const fitting::MeshCode few = fitting::CodeOfMesh(model, face, {.num_points = 100, .ridge = 1e-8});
  EXPECT_LT((few.code - SomeMeshCode()).norm(), 1e-3);
}

TEST(MeshCode, CodesOfManyMeshesAreThoseOfEach) {
  for (const double bend : {0.0, 0.3}) {
    const FieldModel model(bend);
    const auto mesh = [&](int i) { return model.Vertices(0.5 * i * SomeMeshCode()); };
    const Eigen::MatrixXd codes = fitting::CodesOfMeshes(model, 3, mesh, {.num_points = 200});
    for (int i = 0; i < 3; ++i)
      EXPECT_LT((codes.row(i).transpose() - fitting::CodeOfMesh(model, mesh(i), {.num_points = 200}).code).norm(), 1e-3)
          << bend;
  }
}

TEST(MeshCode, RefusesOtherMeshes) {
  const FieldModel model;
  geometry::Points face = model.face_template().neutral;
  ExpectError([&] { fitting::CodeOfMesh(model, face.topRows(10)); }, "a mesh of 10 vertices");
  face(3, 1) = std::numeric_limits<double>::infinity();
  ExpectError([&] { fitting::CodeOfMesh(model, face); }, "no finite number");
}

}  // namespace
}  // namespace daumier::testing
