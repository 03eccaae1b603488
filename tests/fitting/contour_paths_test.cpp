#include "fitting/contour_paths.h"

#include "tests/support/expect_error.h"
#include "tests/support/synthetic_face.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace daumier::testing {
namespace {

TEST(ContourPaths, BeginAtTheLandmarksAndLeadInwards) {
  const faces::FaceTemplate face = SyntheticFace();
  const fitting::ContourPaths paths(face);
  const std::vector<int> all = paths.AllVertices();
  EXPECT_TRUE(std::is_sorted(all.begin(), all.end()));
  for (int k = 0; k < fitting::ContourPaths::kNumJaw; ++k) {
    const std::vector<int>& path = paths.vertices(k);
    ASSERT_FALSE(path.empty());
    EXPECT_EQ(path.front(), face.annotation.landmarks[size_t(k)]);
    EXPECT_LE(std::abs(face.neutral(path.back(), 0)), std::abs(face.neutral(path.front(), 0)) + 1e-9) << k;
    for (const int v : path) EXPECT_TRUE(std::binary_search(all.begin(), all.end(), v));
  }
  EXPECT_EQ(paths.vertices(faces::kChinLandmark).size(), 1u);
}

TEST(ContourPaths, TheOutermostCandidateIsThatOfTheFartherPixel) {
  const faces::FaceTemplate face = SyntheticFace();
  const fitting::ContourPaths paths(face);
  const auto count = Eigen::Index(paths.vertices(1).size());
  ASSERT_GT(count, 2);
  fitting::PicturePoints pixels = fitting::PicturePoints::Zero(count, 2);
  pixels(2, 0) = -5;  // Landmark 1 is on the right of the face, at the left of the picture.
  EXPECT_EQ(paths.Outermost(1, pixels, 0), 2);
  ExpectError([&] { (void)paths.Outermost(1, pixels.topRows(1), 0); }, "pixels of");
}

}  // namespace
}  // namespace daumier::testing
