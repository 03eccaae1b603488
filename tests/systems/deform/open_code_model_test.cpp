#include "systems/deform/open_code_model.h"

#include "core/manifest.h"
#include "tests/support/expect_error.h"
#include "tests/support/paths.h"
#include "tests/support/synthetic_database.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::testing {
namespace {

TEST(OpenCodeModel, FacesBecomeTheirPrincipalComponents) {
  const TempDir folder;
  BuildSyntheticFaces(folder / "faces", 4);
  const deform::OpenedModel opened = deform::OpenCodeModel(folder / "faces");
  EXPECT_EQ(opened.kind, "faces");
  EXPECT_EQ(opened.name, "faces");
  EXPECT_EQ(opened.faces, folder / "faces");
  EXPECT_EQ(opened.data_hash, DataHash(folder / "faces"));
  EXPECT_TRUE(opened.model->is_linear());
  const int num_numbers = opened.model->num_numbers();
  EXPECT_GT(num_numbers, 5);
  EXPECT_LT(num_numbers, 64);
  EXPECT_GT(opened.model->usual_radius(), 1);
  EXPECT_EQ(opened.model->Vertices(Eigen::VectorXd::Zero(num_numbers)).rows(),
            opened.model->face_template().num_vertices());
}

TEST(OpenCodeModel, TheShippedFaceModelHasAnExpressionOfItsOwn) {
  const deform::OpenedModel opened = deform::OpenCodeModel(SourceRoot() / "weights/face-ict");
  EXPECT_EQ(opened.kind, "face model");
  EXPECT_GE(opened.expression.size(), 50u);
  EXPECT_GT(opened.model->num_numbers(), 200);
  EXPECT_TRUE(opened.faces.empty());
}

TEST(OpenCodeModel, RefusesOtherFolders) {
  const TempDir folder;
  ExpectError([&] { deform::OpenCodeModel(folder / "absent"); }, "there is no model here");
  Manifest manifest;
  manifest.kind = "sketches";
  WriteManifest(folder.path(), manifest);
  ExpectError([&] { deform::OpenCodeModel(folder.path()); }, "this is a folder of kind 'sketches'");
}

}  // namespace
}  // namespace daumier::testing
