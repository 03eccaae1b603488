#include "faces/appearance/eyes.h"

#include "tests/faces/appearance/soup_checks.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace daumier::faces {
namespace {

Eyeball UsualEye() {
  Eyeball eyeball;
  eyeball.centre = {3, 1, 2};
  eyeball.radii = {1.8, 1.9, 1.8};
  eyeball.iris_radius = 0.65;
  eyeball.bulge = 0.15;
  return eyeball;
}

/// The mean place of the pupil's black vertices.
geometry::Vector3 PupilOf(const PortraitHead& head) {
  geometry::Vector3 sum = geometry::Vector3::Zero();
  int count = 0;
  for (Eigen::Index v = 0; v < head.vertices.rows(); ++v) {
    if (head.colours.row(v).maxCoeff() > 0.05f) continue;
    sum += head.vertices.row(v).transpose();
    ++count;
  }
  return sum / count;
}

TEST(Eyes, AreClosedAndLookWhereTheGazeGoes) {
  Looks looks;
  looks.highlights = 0;
  HeadSoup ahead = testing::EmptySoup();
  AddEye(UsualEye(), looks, ahead);
  const PortraitHead straight = ahead.Take();
  testing::ExpectClosedSoup(straight);
  EXPECT_GT(testing::VolumeOf(straight), 20);
  EXPECT_NEAR(PupilOf(straight).x(), 3, 1e-6);
  looks.gaze_yaw = 0.3, looks.gaze_pitch = 0.2;
  HeadSoup aside = testing::EmptySoup();
  AddEye(UsualEye(), looks, aside);
  const PortraitHead turned = aside.Take();
  testing::ExpectClosedSoup(turned);
  EXPECT_GT(PupilOf(turned).x(), 3.3) << "to the own left";
  EXPECT_GT(PupilOf(turned).y(), PupilOf(straight).y() + 0.2) << "upwards";
  // Within the ball and its bulge.
  for (const auto& p : turned.vertices.rowwise())
    EXPECT_LT((p.transpose() - UsualEye().centre).cwiseQuotient(UsualEye().radii).norm(), 1.06);
}

TEST(Eyes, HaveHighlightsByTheirNumber) {
  int before = 0;
  for (const int count : {0, 1, 2}) {
    Looks looks;
    looks.highlights = count;
    HeadSoup soup = testing::EmptySoup();
    AddEye(UsualEye(), looks, soup);
    const PortraitHead head = soup.Take();
    const int found = int(std::count(head.parts.begin(), head.parts.end(), uint8_t(PicturePart::kHighlight)));
    EXPECT_EQ(found, 10 * count);
    EXPECT_GE(found, before);
    before = found;
  }
}

}  // namespace
}  // namespace daumier::faces
