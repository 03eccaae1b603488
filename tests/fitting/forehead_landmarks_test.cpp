#include "fitting/forehead_landmarks.h"

#include "faces/face_model_file.h"
#include "tests/support/paths.h"
#include "tests/support/synthetic_face.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace daumier::fitting {
namespace {

void ExpectLine(const faces::FaceTemplate& face) {
  const auto landmarks = ForeheadLandmarks(face);
  const auto at = [&](int number) -> geometry::Vector3 {
    return face.neutral.row(landmarks[size_t(number - 68)]).transpose();
  };
  EXPECT_EQ(std::set<int>(landmarks.begin(), landmarks.end()).size(), size_t(kNumForeheadLandmarks));
  // From the face's right (-x) to its left, and as high on one side as on the other.
  const std::array<int, 13> line = {77, 75, 76, 68, 69, 70, 71, 80, 72, 73, 79, 74, 78};
  const double size = (at(77) - at(78)).norm();
  for (size_t k = 1; k < line.size(); ++k) {
    EXPECT_GE(at(line[k]).x(), at(line[k - 1]).x() - 0.02 * size) << line[k];
    EXPECT_NEAR(at(line[k]).y(), at(line[12 - k]).y(), 0.06 * size) << line[k];
    EXPECT_NEAR((at(line[k]) - at(line[k - 1])).norm(), size / 7, size / 9) << line[k];
  }
  EXPECT_NEAR(at(71).x(), 0, 0.06 * size);
  const auto mark = [&](int k) { return face.neutral(face.annotation.landmarks[size_t(k)], 1); };
  for (const int number : line) EXPECT_GT(at(number).y(), mark(1)) << number;
  for (const int number : {69, 70, 71, 80, 72}) EXPECT_GT(at(number).y(), std::max(mark(19), mark(24))) << number;
}

TEST(ForeheadLandmarks, RunAlongTheHairlineFromRightToLeft) {
  ExpectLine(testing::SyntheticFace());
  ExpectLine(faces::ReadFaceModelWeights(testing::SourceRoot() / "weights/face-ict").face_template);
}

}  // namespace
}  // namespace daumier::fitting
