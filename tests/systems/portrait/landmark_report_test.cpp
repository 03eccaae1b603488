#include "systems/portrait/landmark_report.h"

#include <gtest/gtest.h>

#include <limits>

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

TEST(LandmarkReport, PartsWhoseTruthIsNotKnownAreNull) {
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  std::vector<PictureMeasurement> pictures = {{.name = "a", .found = true}, {.name = "b", .found = true}};
  pictures[0].errors = LandmarkErrors{0.02, {unknown, 0.01, unknown, 0.03, unknown}};
  pictures[1].errors = LandmarkErrors{0.04, {unknown, 0.03, unknown, unknown, unknown}};
  pictures[1].boxed = LandmarkErrors{0.06, {0.06, 0.06, 0.06, 0.06, 0.06}};
  const Json json = PicturesToJson(pictures);
  EXPECT_NEAR(json["mean"].get<double>(), 0.03, 1e-12);
  EXPECT_NEAR(json["brows_median"].get<double>(), 0.02, 1e-12);
  EXPECT_NEAR(json["eyes_median"].get<double>(), 0.03, 1e-12);
  EXPECT_TRUE(json["jaw_median"].is_null());
  EXPECT_TRUE(json["pictures"][1]["eyes"].is_null());
  EXPECT_EQ(json["box_given"]["num"], 1);
  const reports::ReportTable table = PicturesTable(json);
  EXPECT_EQ(table.rows[0][1], "2 of 2");
  EXPECT_EQ(table.rows[1][1], "1 of 2");
  pictures[1].boxed.reset();
  EXPECT_EQ(PicturesTable(PicturesToJson(pictures)).rows.size(), 1u);
}

}  // namespace
}  // namespace daumier::portrait
