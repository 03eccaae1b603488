#include "systems/portrait/train/portrait_measurement.h"

#include "systems/portrait/portrait_metrics.h"
#include "tests/support/expect_error.h"
#include "tests/systems/portrait/train/small_portrait_runs.h"

namespace daumier::portrait {
namespace {

struct CropProblem {
  faces::MorphableModel model = testing::SyntheticMorphable();
  datasets::PortraitDatabase portraits{testing::SmallPortraitFolder() / "portraits"};
  std::vector<int> images = {1, 4, 7};
  std::vector<PictureMap> maps = std::vector<PictureMap>(3);
  PortraitGuesses Truth() const {
    const std::vector<std::vector<float>> all = testing::TrueCoefficients();
    return {{all[1], all[4], all[7]}, 5.0};
  }
};

TEST(CropMeasurement, FindsNoErrorOfTheTruth) {
  const CropProblem p;
  CropMeasurement measurement(p.model, p.portraits, p.images, p.maps, 1);
  measurement.AddRow("truth", p.Truth());
  const reports::MetricTable& table = measurement.table();
  ASSERT_EQ(table.rows.size(), 1U);
  const auto value = [&](const char* key) { return reports::ValueOf(table, table.rows[0], key).value(); };
  EXPECT_LT(value("error"), 0.02);  // Vertices are stored in units of 0.001 cm.
  EXPECT_LT(value("landmark_error"), 1e-4);
  EXPECT_LT(value("angle_error"), 0.01);
  EXPECT_LT(value("photometric"), 3.0 / 255);
  EXPECT_LT(value("mouth"), 0.02);
  EXPECT_EQ(value("num_images"), 3);
  EXPECT_EQ(value("ms"), 5);
  EXPECT_EQ(table.faces, p.images);
  EXPECT_EQ(table.groups, (std::vector<int>{0, 2, 3}));
}

TEST(CropMeasurement, MeasuresTheFirstPortraitsAgainstGuesses) {
  const CropProblem p;
  CropMeasurement measurement(p.model, p.portraits, p.images, p.maps, 1);
  // The truth, turned by 0.1 about the axis of view and moved: the shape stays, angles and landmarks do not.
  PortraitGuesses guesses{{p.Truth().coefficients[0]}};
  guesses.coefficients[0][size_t(faces::kPoseSlot.first + 2)] += 0.1F;
  guesses.coefficients[0][size_t(faces::kPoseSlot.first + 3)] += 1;
  measurement.AddRow("turned", guesses, true);
  const reports::MetricTable& table = measurement.table();
  EXPECT_TRUE(table.rows[0].baseline);
  const auto value = [&](const char* key) { return reports::ValueOf(table, table.rows[0], key); };
  EXPECT_LT(*value("error"), 0.02);
  EXPECT_NEAR(*value("angle_error"), 0.1 * 180 / M_PI, 0.01);
  EXPECT_GT(*value("landmark_error"), 0.05);
  EXPECT_EQ(*value("num_images"), 1);
  EXPECT_FALSE(value("ms"));
}

TEST(CropMeasurement, SeesTheSameFaceInAnyCrop) {
  const CropProblem p;
  PictureMap map;
  map.linear *= 1.2;
  map.shift = {-20, -25};
  const CropMeasurement measurement(p.model, p.portraits, {4}, {map}, 1);
  const MeasuredPortrait& portrait = measurement.portraits()[0];
  EXPECT_NEAR(portrait.landmarks[0], 1.2 * p.portraits.landmarks(4)[0] - 20, 1e-3);
  EXPECT_NEAR(portrait.landmarks[1], 1.2 * p.portraits.landmarks(4)[1] - 25, 1e-3);
  EXPECT_EQ(portrait.person, 2);
  EXPECT_EQ(portrait.crop.width, kPortraitSide);
  // What the mask calls skin covers 1.44 times as much, as far as it is in the crop.
  double covered = 0, before = 0;
  for (const float shown : portrait.shown) covered += shown;
  for (const float shown : FaceMask(p.portraits.mask(4))) before += shown;
  EXPECT_GT(covered, 1.1 * before);
  EXPECT_LT(covered, 1.46 * before);
}

TEST(CropMeasurement, RefusesNumbersThatDoNotBelongTogether) {
  const CropProblem p;
  testing::ExpectError(
      [&] {
        CropMeasurement(p.model, p.portraits, {1, 2}, p.maps, 1);
      },
      "2 portraits with 3 crops are measured");
  CropMeasurement measurement(p.model, p.portraits, {1}, {PictureMap{}}, 1);
  testing::ExpectError([&] { measurement.AddRow("none", {}); }, "row 'none' has 0 guesses for 1 portraits");
  testing::ExpectError([&] { measurement.AddRow("many", p.Truth()); }, "row 'many' has 3 guesses for 1 portraits");
}

}  // namespace
}  // namespace daumier::portrait
