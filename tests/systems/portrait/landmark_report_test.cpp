#include "systems/portrait/landmark_report.h"

#include <gtest/gtest.h>

namespace daumier::portrait {
namespace {

TEST(LandmarkReport, SpreadOverTonesIsTheRangeOverTheMean) {
  const Json tones = TonesToJson({{0, {0.02, 0.04}}, {5, {0.05}}});
  EXPECT_NEAR(tones["tones"]["0"]["error"].get<double>(), 0.03, 1e-12);
  EXPECT_NEAR(tones["spread"].get<double>(), 0.5, 1e-12);
}

TEST(LandmarkReport, CountsFalseFacesAtTheThreshold) {
  const std::vector<NegativeMeasurement> negatives = {{"a", 0.05}, {"b", 0.45}, {"c", 0.7}};
  const Json json = NegativesToJson(negatives, 0.5);
  EXPECT_EQ(json["false_faces"], 1);
  EXPECT_EQ(json["by_threshold"]["0.40"], 2);
  EXPECT_EQ(json["pictures"].size(), 2u);
}

}  // namespace
}  // namespace daumier::portrait
