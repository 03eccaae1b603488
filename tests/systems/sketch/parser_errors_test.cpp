#include "systems/sketch/parser_errors.h"

#include <gtest/gtest.h>

#include <set>

namespace daumier::sketch {
namespace {

using enum faces::FacePoint;

DrawnPoints Eyes() {
  DrawnPoints points;
  points[size_t(kEyeRightOuter)] = {0, 0};
  points[size_t(kEyeLeftOuter)] = {100, 0};
  return points;
}

TEST(ParserErrors, AreMeanDistancesOverTheEyeDistance) {
  DrawnPoints truth = Eyes(), found = Eyes();
  truth[size_t(kChin)] = {50, 120};
  found[size_t(kChin)] = {53, 124};
  found[size_t(kLipTop)] = {1, 1};  // Not shown: it does not count.
  const auto errors = ErrorsOfPoints(found, truth);
  ASSERT_TRUE(errors);
  EXPECT_NEAR(errors->all, 0.05 / 3, 1e-12);
  EXPECT_NEAR(*errors->parts[4], 0.05, 1e-12);
  EXPECT_NEAR(*errors->parts[0], 0, 1e-12);
  EXPECT_FALSE(errors->parts[3]);
}

TEST(ParserErrors, CentresCountWhereTheEyesAreMarks) {
  DrawnPoints truth;
  truth[size_t(kEyeRightCentre)] = {0, 0};
  truth[size_t(kEyeLeftCentre)] = {100, 0};
  DrawnPoints found = truth;
  found[size_t(kEyeLeftCentre)] = {100, 13.69};
  EXPECT_NEAR(*EyeDistance(truth), 136.9, 1e-9);
  EXPECT_NEAR(ErrorsOfPoints(found, truth)->all, 0.05, 1e-12);
  truth[size_t(kEyeRightOuter)] = {-20, 0};
  truth[size_t(kEyeLeftOuter)] = {120, 0};
  found[size_t(kEyeRightOuter)] = {-20, 0};
  found[size_t(kEyeLeftOuter)] = {120, 0};
  EXPECT_NEAR(ErrorsOfPoints(found, truth)->all, 0, 1e-12);
}

TEST(ParserErrors, WithoutEyesThereAreNone) {
  DrawnPoints truth;
  truth[size_t(kChin)] = {0, 0};
  EXPECT_FALSE(ErrorsOfPoints(truth, truth));
}

TEST(ParserErrors, PartsHoldEachPointOnce) {
  std::set<faces::FacePoint> seen;
  size_t count = 0;
  for (const PointPart& part : PointParts()) {
    seen.insert(part.points.begin(), part.points.end());
    count += part.points.size();
  }
  EXPECT_EQ(seen.size(), size_t(faces::kNumFacePoints));
  EXPECT_EQ(count, seen.size());
}

TEST(ClassCounts, BalancedAccuracyIsTheMeanRecallOfClassesThatOccur) {
  ClassCounts counts(3);
  EXPECT_EQ(counts.balanced_accuracy(), 0);
  for (int i = 0; i < 3; ++i) counts.Add(0, 0);
  counts.Add(0, 1);
  counts.Add(1, 1);
  EXPECT_EQ(counts.num(), 5);
  EXPECT_NEAR(counts.balanced_accuracy(), (0.75 + 1) / 2, 1e-12);
  const Json json = counts.ToJson(faces::kMouthStateNames);
  EXPECT_EQ(json["of_classes"]["closed"]["num"], 4);
  EXPECT_TRUE(json["of_classes"]["teeth"]["recall"].is_null());
}

}  // namespace
}  // namespace daumier::sketch
