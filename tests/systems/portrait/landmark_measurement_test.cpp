#include "systems/portrait/landmark_measurement.h"

#include "core/files.h"
#include "systems/portrait/landmark_files.h"
#include "tests/support/drawn_portraits.h"
#include "tests/support/expect_error.h"
#include "tests/support/ideal_landmark_network.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

namespace daumier::portrait {
namespace {

LandmarkDetector DetectorOf(std::vector<std::vector<float>> faces) {
  auto network = std::make_shared<testing::IdealLandmarkNetwork>();
  network->faces = std::move(faces);
  return {{}, network, {.even_jaw = false}};
}

TEST(MeanShapeInBox, OfOneSampleIsThatSample) {
  const testing::DrawnPortraits portraits(2);
  const std::vector<float> truth = portraits.Get(1).landmarks;
  const std::vector<float> shape = MeanShapeInBox(portraits, std::vector<int>{1});
  const std::vector<float> placed = ShapeInBox(shape, BoxOf(truth));
  for (size_t i = 0; i < truth.size(); ++i) EXPECT_NEAR(placed[i], truth[i], 1e-3);
}

TEST(MeasurePortrait, APerfectDetectorMissesByLittleAndTheMeanShapeByMore) {
  LandmarkSample sample{testing::PictureOfPlaces(200, 200),
                        render::Image(200, 200, 1, 1),
                        testing::PlausibleLandmarks(50, 40, 90),
                        std::vector<uint8_t>(68, 1),
                        {8, 8, 0},
                        3};
  const std::vector<float> shape = MeanShapeInBox(testing::DrawnPortraits(4), std::vector<int>{0, 1, 2, 3});
  LabelCounts labels;
  const PortraitMeasurement measured = MeasurePortrait(DetectorOf({sample.landmarks}), sample, shape, labels);
  EXPECT_TRUE(measured.found);
  EXPECT_LT(measured.searched.all, 0.01);
  EXPECT_LT(measured.boxed.all, 0.01);
  EXPECT_GT(measured.mean_shape.all, 0.02);
  EXPECT_EQ(measured.wrong_states, (std::array<int64_t, 4>{0, 0, 0, 0}));
  EXPECT_EQ(measured.known_states, (std::array<int64_t, 4>{1, 1, 1, 1}));
  const PortraitMeasurement missed = MeasurePortrait(DetectorOf({}), sample, shape, labels);
  EXPECT_FALSE(missed.found);
  EXPECT_GT(missed.searched.all, 0.05);
}

TEST(MeasurePictures, FindsFacesOfAFolderWithTheirErrorsAndThoseOfARival) {
  const testing::TempDir folder;
  const std::vector<float> truth = testing::PlausibleLandmarks(50, 40, 90);
  std::vector<float> shifted = truth;
  for (float& value : shifted) value += 2;
  MakeDirectory(folder / "rival");
  for (const char* name : {"10", "9"}) {
    render::WriteImage(folder / (std::string(name) + ".png"), testing::PictureOfPlaces(200, 200));
    WriteFileAtomically(folder / (std::string(name) + ".txt"), LandmarksAsPts(truth));
  }
  WriteFileAtomically(folder / "rival" / "9.pts", LandmarksAsPts(shifted));
  const auto pictures = MeasurePictures(DetectorOf({truth}), folder.path(), folder / "rival");
  ASSERT_EQ(pictures.size(), 2u);
  EXPECT_EQ(pictures[0].name, "9.png");  // 9 before 10.
  EXPECT_TRUE(pictures[0].found);
  EXPECT_LT(pictures[0].errors->all, 0.01);
  ASSERT_TRUE(pictures[0].rival.has_value());
  EXPECT_NEAR(pictures[0].rival->all, std::sqrt(8.0) / InterocularDistance(truth), 1e-4);
  EXPECT_FALSE(pictures[1].rival.has_value());
  testing::ExpectError([&] { MeasurePictures(DetectorOf({}), folder / "rival", ""); },
                       "holds no picture with landmarks");
}

TEST(MeasurePictures, MeasuresTheLandmarksThatAreKnown) {
  const testing::TempDir folder;
  const std::vector<float> truth = testing::PlausibleLandmarks(50, 40, 90);
  std::string text;
  for (size_t i = 0; i < 68; ++i) {
    const bool is_known = i >= 36 && i < 60;  // Eyes, and the outer lips, of which the mean error is that of a shift.
    text += is_known ? fmt::format("{} {}\n", truth[2 * i] + (i < 48 ? 0 : 3), truth[2 * i + 1]) : "nan nan\n";
  }
  WriteFileAtomically(folder / "a.txt", text);
  render::WriteImage(folder / "a.png", testing::PictureOfPlaces(200, 200));
  const auto pictures = MeasurePictures(DetectorOf({truth}), folder.path(), "");
  ASSERT_TRUE(pictures.at(0).found);
  EXPECT_FALSE(pictures[0].boxed.has_value());
  const LandmarkErrors& errors = *pictures[0].errors;
  EXPECT_LT(errors.parts[3], 0.01);
  EXPECT_NEAR(errors.parts[4], 3 / InterocularDistance(truth), 0.01);
  EXPECT_NEAR(errors.all, 0.5 * (errors.parts[3] + errors.parts[4]), 1e-9);
  EXPECT_TRUE(std::isnan(errors.parts[0]));
  EXPECT_FALSE(MeasurePictures(DetectorOf({testing::PlausibleLandmarks(5, 5, 40)}), folder.path(), "").at(0).found);
}

TEST(MeasureNegatives, ReturnsTheConfidenceOfTheBestCandidate) {
  const testing::TempDir folder;
  render::WriteImage(folder / "a.png", testing::PictureOfPlaces(120, 120));
  EXPECT_EQ(MeasureNegatives(DetectorOf({}), folder.path()).front().confidence, 0);
  EXPECT_GT(MeasureNegatives(DetectorOf({testing::PlausibleLandmarks(30, 30, 50)}), folder.path()).front().confidence,
            0.9);
}

}  // namespace
}  // namespace daumier::portrait
