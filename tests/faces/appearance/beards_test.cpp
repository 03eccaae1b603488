#include "faces/appearance/beards.h"

#include "geometry/normals.h"
#include "tests/faces/appearance/soup_checks.h"

#include <gtest/gtest.h>

namespace daumier::faces {
namespace {

TEST(Beards, AreClosedAndLeaveTheLipsFree) {
  const FaceTemplate face = testing::SyntheticFace();
  const BeardShells shells(face);
  const geometry::Points normals = geometry::VertexNormals({face.neutral, face.triangles});
  for (size_t style = 1; style < kBeardStyleNames.size(); ++style) {
    Looks looks;
    looks.beard = static_cast<BeardStyle>(style);
    HeadSoup soup = testing::EmptySoup();
    shells.AddBeard(face.neutral, normals, looks, 1, soup);
    const PortraitHead beard = soup.Take();
    testing::ExpectClosedSoup(beard);
    EXPECT_GT(testing::VolumeOf(beard), 0) << kBeardStyleNames[style];
    const double chin = face.neutral(face.annotation.landmarks[8], 1);
    if (BeardStyle(style) == BeardStyle::kLong) {
      EXPECT_LT(beard.vertices.col(1).minCoeff(), chin - 3);
    }
    // No vertex over the middle of the lips.
    const auto lip = face.neutral.row(face.annotation.landmarks[62]);
    EXPECT_GT((beard.vertices.rowwise() - lip).rowwise().norm().minCoeff(), 0.2);
  }
  HeadSoup none = testing::EmptySoup();
  shells.AddBeard(face.neutral, normals, Looks{}, 1, none);
  EXPECT_EQ(none.size(), 0);
}

}  // namespace
}  // namespace daumier::faces
