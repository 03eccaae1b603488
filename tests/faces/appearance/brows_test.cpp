#include "faces/appearance/brows.h"

#include "geometry/normals.h"
#include "tests/faces/appearance/soup_checks.h"

#include <gtest/gtest.h>

namespace daumier::faces {
namespace {

TEST(Brows, AreClosedReliefOnTheSkin) {
  const FaceTemplate face = testing::SyntheticFace();
  const BrowPatches patches(face);
  const geometry::Points normals = geometry::VertexNormals({face.neutral, face.triangles});
  double thin = 0;
  for (const double thickness : {0.7, 1.6}) {
    Looks looks;
    looks.brow_thickness = thickness;
    HeadSoup soup = testing::EmptySoup();
    patches.AddBrows(face.neutral, normals, looks, soup);
    const PortraitHead brows = soup.Take();
    testing::ExpectClosedSoup(brows);
    EXPECT_GT(testing::VolumeOf(brows), thin);
    thin = testing::VolumeOf(brows);
    const auto landmark = face.neutral.row(face.annotation.landmarks[19]);
    EXPECT_LT((brows.vertices.rowwise() - landmark).rowwise().norm().minCoeff(), 0.8);
    EXPECT_NEAR(brows.vertices.col(0).minCoeff(), -brows.vertices.col(0).maxCoeff(), 0.05);
  }
}

TEST(Brows, LashesAreClosedAndAbsentWithoutLength) {
  const FaceTemplate face = testing::SyntheticFace();
  const BrowPatches patches(face);
  const geometry::Points normals = geometry::VertexNormals({face.neutral, face.triangles});
  Looks looks;
  HeadSoup soup = testing::EmptySoup();
  patches.AddLashes(face.neutral, normals, looks, soup);
  const PortraitHead lashes = soup.Take();
  testing::ExpectClosedSoup(lashes);
  EXPECT_GT(testing::VolumeOf(lashes), 0);
  looks.lash_length = looks.lid_line = 0;
  HeadSoup none = testing::EmptySoup();
  patches.AddLashes(face.neutral, normals, looks, none);
  EXPECT_EQ(none.size(), 0);
}

}  // namespace
}  // namespace daumier::faces
