#include "faces/expression_repair.h"

#include "geometry/flips.h"
#include "tests/support/from_threads.h"
#include "tests/support/synthetic_face.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace daumier::faces {
namespace {

/// The synthetic face as the regular one, and made faces with a fault.
class Repairing : public ::testing::Test {
 protected:
  FaceTemplate face_ = testing::SyntheticFace();
  ExpressionRepair repair_{face_};
  FaceOpenings openings_ = FindOpenings(face_);

  int NumFlips(const geometry::Points& points) const {
    return geometry::CountFlippedTriangles(face_.neutral, points, face_.triangles,
                                           RegionFor(face_.annotation, "face", "a test"));
  }
  /// The lower side raised until it lies `depth` cm above the upper one.
  geometry::Points Crossed(const Opening& opening, double depth) const {
    double gap = 0;
    for (const auto& [upper, lower] : opening.pairs)
      gap = std::max(gap, face_.neutral(upper, 1) - face_.neutral(lower, 1));
    geometry::Points points = face_.neutral;
    for (const int v : opening.lower) {
      if (v != opening.upper.front() && v != opening.upper.back()) points(v, 1) += gap + depth;
    }
    return points;
  }
  /// A spot of the cheek folded over: its points mirrored about a line.
  geometry::Points Folded() const {
    const Eigen::RowVector3d nose = face_.neutral.row(face_.annotation.landmarks[30]);
    geometry::Points points = face_.neutral;
    for (const int v : RegionFor(face_.annotation, "face", "a test")) {
      if ((face_.neutral.row(v) - nose).norm() < 2) points(v, 0) = nose.x() - 1.5 * (face_.neutral(v, 0) - nose.x());
    }
    return points;
  }
};

TEST_F(Repairing, LeavesAHarmlessExpressionUnchanged) {
  geometry::Points made = face_.neutral;
  made.col(1) *= 1.05;
  EXPECT_EQ(repair_.Repair(made, face_.neutral), made);
}

TEST_F(Repairing, LipsThatCrossPart) {
  const geometry::Points made = Crossed(openings_.lips, 0.3);
  ASSERT_GT(CrossingDepth(openings_.lips, made), 0.1);
  EXPECT_LE(CrossingDepth(openings_.lips, repair_.Repair(made, face_.neutral)), 0.02);
}

TEST_F(Repairing, LidsThatCrossPart) {
  for (const Opening& lids : openings_.lids) {
    const geometry::Points made = Crossed(lids, 0.1);
    ASSERT_GT(CrossingDepth(lids, made), 0.05);
    EXPECT_LE(CrossingDepth(lids, repair_.Repair(made, face_.neutral)), ExpressionRepair::kCrossing);
  }
}

TEST_F(Repairing, MayCrossAsDeepAsTheRegularOnes) {
  const geometry::Points made = Crossed(openings_.lips, 0.3);
  EXPECT_EQ(repair_.Repair(made, made), made);
}

TEST_F(Repairing, FlipsEnd) {
  const geometry::Points made = Folded();
  ASSERT_GT(NumFlips(made), 5);
  EXPECT_EQ(NumFlips(repair_.Repair(made, face_.neutral)), 0);
}

TEST_F(Repairing, PlacesAwayFromAFaultAreUnchanged) {
  geometry::Points made = Crossed(openings_.lips, 0.3);
  const int ear = face_.annotation.landmarks[0];
  made(ear, 0) += 0.01;
  EXPECT_EQ(repair_.Repair(made, face_.neutral).row(ear), made.row(ear));
}

TEST_F(Repairing, SeveralThreadsGetTheSame) {
  const geometry::Points made = Folded();
  testing::ExpectTheSameFromThreads(3, [&] { return repair_.Repair(made, face_.neutral); });
}

}  // namespace
}  // namespace daumier::faces
