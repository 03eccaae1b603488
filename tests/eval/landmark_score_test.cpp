#include "eval/landmark_score.h"

#include "core/random.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::testing {
namespace {

using eval::LandmarkPair;
using eval::LandmarkRow;

/// A face of random points in a picture of 200 pixels, whose eye corners are 50 pixels apart.
LandmarkRow RandomLandmarks(uint64_t seed) {
  Rng rng(seed);
  LandmarkRow row;
  for (size_t i = 0; i < 68; ++i) row[2 * i] = rng.Uniform(70, 160), row[2 * i + 1] = rng.Uniform(20, 130);
  row[72] = 80, row[73] = 60, row[90] = 130, row[91] = 60;
  return row;
}

template <class Change>
std::vector<LandmarkPair> PairsAfter(const Change& change, double noise = 1) {
  std::vector<LandmarkPair> pairs;
  for (uint64_t seed = 1; seed <= 9; ++seed) {
    LandmarkPair pair{RandomLandmarks(seed), RandomLandmarks(seed), 200};
    Rng rng(100 + seed);
    for (size_t i = 0; i < 68; ++i) {
      pair.predicted[2 * i] += noise * rng.Normal(), pair.predicted[2 * i + 1] += noise * rng.Normal();
      change(pair.predicted[2 * i], pair.predicted[2 * i + 1]);
    }
    pairs.push_back(pair);
  }
  return pairs;
}

TEST(NormalisedMeanError, IsAShareOfTheDistanceOfTheEyeCorners) {
  const LandmarkRow truth = RandomLandmarks(1);
  EXPECT_EQ(eval::NormalisedMeanError(truth, truth), 0);
  LandmarkRow moved = truth;
  for (size_t i = 0; i < 68; ++i) moved[2 * i] += 3, moved[2 * i + 1] += 4;
  EXPECT_NEAR(eval::NormalisedMeanError(moved, truth), 5.0 / 50, 1e-12);
}

TEST(NormalisedMeanError, CountsTheChosenLandmarksAlone) {
  const LandmarkRow truth = RandomLandmarks(1);
  LandmarkRow moved = truth;
  moved[0] += 10;
  std::vector<uint8_t> counts(68, 0);
  counts[0] = counts[1] = 1;
  EXPECT_NEAR(eval::NormalisedMeanError(moved, truth, counts), 0.5 * 10 / 50, 1e-12);
  ExpectError([&] { eval::NormalisedMeanError(moved, truth, std::vector<uint8_t>(68, 0)); }, "no landmark counts");
}

TEST(NormalisedMeanError, NeedsEyesThatAreApart) {
  ExpectError([] { eval::NormalisedMeanError({}, {}); }, "coincide");
}

TEST(UnitMistake, IsNamedWithItsRepair) {
  const auto text = [](const auto& change) { return eval::UnitMistake(PairsAfter(change)).value_or("none"); };
  EXPECT_EQ(text([](double&, double&) {}), "none");
  EXPECT_NE(text([](double& x, double& y) { x /= 200, y /= 200; }).find("Multiply them by the picture's size"),
            std::string::npos);
  EXPECT_NE(text([](double&, double& y) { y = 200 - y; }).find("upwards"), std::string::npos);
  EXPECT_NE(text([](double& x, double& y) { std::swap(x, y); }).find("exchanged"), std::string::npos);
  EXPECT_NE(text([](double& x, double& y) { x *= 2, y *= 2; }).find("Multiply them by about 0.5"), std::string::npos);
}

TEST(UnitMistake, IsNoLargeErrorOfAMethod) {
  EXPECT_FALSE(eval::UnitMistake(PairsAfter([](double&, double&) {}, 60)).has_value());
  EXPECT_FALSE(eval::UnitMistake({}).has_value());
}

}  // namespace
}  // namespace daumier::testing
