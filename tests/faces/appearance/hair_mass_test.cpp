#include "faces/appearance/hair_mass.h"

#include "geometry/topology.h"
#include "geometry/weld.h"
#include "tests/support/expect_error.h"
#include "tests/support/from_threads.h"
#include "tests/support/synthetic_face.h"

#include <gtest/gtest.h>

namespace daumier::faces {
namespace {

TEST(HairMaker, MakesClosedSurfacesAroundTheSkull) {
  const FaceTemplate face = daumier::testing::SyntheticFace();
  const HairMaker maker(face);
  for (size_t style = 1; style < kHairStyleNames.size(); ++style) {
    Looks looks;
    looks.hair = HairStyle(style);
    const HairMass hair = maker.Make(face.neutral, looks);
    ASSERT_GT(hair.mesh.triangles.rows(), 0) << kHairStyleNames[style];
    EXPECT_EQ(hair.colours.rows(), hair.mesh.vertices.rows());
    EXPECT_TRUE(hair.mesh.vertices.allFinite());
    // Each column of the hair has a vertex of its own at the crown.
    const geometry::TriangleMesh welded =
        geometry::WeldedSurface(hair.mesh, geometry::WeldTolerance(hair.mesh.vertices));
    EXPECT_TRUE(geometry::BoundaryLoops(welded.triangles, int(welded.vertices.rows())).empty())
        << kHairStyleNames[style];
  }
}

TEST(HairMaker, GivesBaldHeadsNothing) {
  const FaceTemplate face = daumier::testing::SyntheticFace();
  Looks looks;
  looks.hair = HairStyle::kBald;
  EXPECT_EQ(HairMaker(face).Make(face.neutral, looks).mesh.triangles.rows(), 0);
}

TEST(HairMaker, FollowsTheFaceAndItsColour) {
  const FaceTemplate face = daumier::testing::SyntheticFace();
  const HairMaker maker(face);
  Looks looks;
  looks.hair_colour = {0.8F, 0.1F, 0.1F};
  const HairMass hair = maker.Make(face.neutral, looks);
  const geometry::Points moved = face.neutral.rowwise() + Eigen::RowVector3d(1, 2, 3);
  const HairMass of_moved = maker.Make(moved, looks);
  ASSERT_EQ(of_moved.mesh.vertices.rows(), hair.mesh.vertices.rows());
  EXPECT_LT(((of_moved.mesh.vertices.rowwise() - Eigen::RowVector3d(1, 2, 3)) - hair.mesh.vertices)
                .rowwise()
                .norm()
                .maxCoeff(),
            1e-6);
  EXPECT_GT(hair.colours.col(0).mean(), 4 * hair.colours.col(1).mean());
}

TEST(HairMaker, MayBeUsedFromSeveralThreads) {
  const FaceTemplate face = daumier::testing::SyntheticFace();
  const HairMaker maker(face);
  daumier::testing::ExpectTheSameFromThreads(2, [&] { return maker.Make(face.neutral, Looks()).mesh.vertices; });
}

TEST(HairStyleNamed, KnowsItsNames) {
  EXPECT_EQ(HairStyleNamed("long"), HairStyle::kLong);
  daumier::testing::ExpectError([] { HairStyleNamed("mohawk"); }, "expected bald, short");
}

}  // namespace
}  // namespace daumier::faces
