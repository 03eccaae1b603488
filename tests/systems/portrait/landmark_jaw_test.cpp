#include "systems/portrait/landmark_jaw.h"

#include "systems/portrait/landmark_sample.h"
#include "tests/support/expect_error.h"
#include "tests/support/ideal_landmark_network.h"

#include <gtest/gtest.h>

namespace daumier::portrait {
namespace {

TEST(EvenJaw, SpacesEachHalfOfAnAngle) {
  // Down 8 and then right 16, at distances that grow: 0, 1/8, 4/8, ... of each side.
  std::vector<float> landmarks(2 * size_t(kNumLandmarks), 7);
  for (int k = 0; k <= 8; ++k) {
    landmarks[2 * size_t(k)] = 0, landmarks[2 * size_t(k) + 1] = float(k * k) / 8;
    landmarks[2 * size_t(8 + k)] = float(k * k) / 4, landmarks[2 * size_t(8 + k) + 1] = 8;
  }
  const std::vector<float> even = EvenJaw(landmarks);
  for (int k = 0; k <= 8; ++k) {
    EXPECT_NEAR(even[2 * size_t(k)], 0, 1e-5);
    EXPECT_NEAR(even[2 * size_t(k) + 1], k, 1e-5);
    EXPECT_NEAR(even[2 * size_t(8 + k)], 2 * k, 1e-5);
    EXPECT_NEAR(even[2 * size_t(8 + k) + 1], 8, 1e-5);
  }
  for (size_t i = 34; i < even.size(); ++i) EXPECT_EQ(even[i], 7);
}

TEST(EvenJaw, KeepsEndsAndChinAndWhatIsInOnePoint) {
  const std::vector<float> landmarks = testing::PlausibleLandmarks(20, 30, 90);
  const std::vector<float> even = EvenJaw(landmarks);
  for (const size_t n : {0u, 8u, 16u, 17u, 67u}) {
    EXPECT_EQ(even[2 * n], landmarks[2 * n]);
    EXPECT_EQ(even[2 * n + 1], landmarks[2 * n + 1]);
  }
  const std::vector<float> point(2 * size_t(kNumLandmarks), 3);
  EXPECT_EQ(EvenJaw(point), point);
}

TEST(EvenJaw, RefusesOtherNumbersOfLandmarks) {
  testing::ExpectError([] { EvenJaw(std::vector<float>(10)); }, "10 numbers of landmarks, expected 136");
}

}  // namespace
}  // namespace daumier::portrait
