#include "datasets/build/landmark_translation.h"

#include "tests/support/synthetic_face.h"

#include <gtest/gtest.h>

namespace daumier::datasets {
namespace {

TEST(LandmarkTranslation, IsFoundFromFarAway) {
  const faces::FaceTemplate face = testing::SyntheticFace();
  const geometry::TriangleMesh mesh{face.neutral, face.triangles};
  const geometry::TriangleTree tree(mesh);
  for (const geometry::Vector3& move :
       {geometry::Vector3(30, -150, 0), geometry::Vector3(1, 2, 3), geometry::Vector3(-1e4, 0, 500)}) {
    geometry::Points places(68, 3);
    for (int l = 0; l < 68; ++l)
      places.row(l) = face.neutral.row(face.annotation.landmarks[size_t(l)]) + move.transpose();
    EXPECT_LT((TranslationOnto(mesh, tree, places) + move).norm(), 0.05) << move.transpose();
  }
}

}  // namespace
}  // namespace daumier::datasets
