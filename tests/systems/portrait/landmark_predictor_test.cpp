#include "systems/portrait/landmark_predictor.h"

#include "core/files.h"
#include "systems/portrait/landmark_files.h"
#include "tests/support/expect_error.h"
#include "tests/support/ideal_landmark_network.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::portrait {
namespace {

TEST(LandmarkPredictor, GivenLandmarksAndMaskTakeThePlaceOfTheNetworks) {
  const testing::TempDir folder;
  const std::vector<float> given = testing::PlausibleLandmarks(61, 52, 80);
  WriteFileAtomically(folder / "face.pts", LandmarksAsPts(given));
  render::WriteImage(folder / "mask.png", render::Image(200, 200, 1, 1));
  auto network = std::make_shared<testing::IdealLandmarkNetwork>();
  network->faces = {testing::PlausibleLandmarks(60, 50, 80)};
  const LandmarkPredictor predictor(
      {}, network, {.landmarks = (folder / "face.pts").string(), .mask = (folder / "mask.png").string()});
  const std::vector<systems::Input> inputs = {testing::PictureOfPlaces(200, 200)};
  const systems::FaceResult result = predictor.Predict(inputs).front();
  EXPECT_EQ(result.files.front().text, LandmarksAsPts(ReadLandmarks(folder / "face.pts")));
  EXPECT_EQ(result.masks.front().image, render::Image(200, 200, 1, 1));
  EXPECT_EQ(result.record["faces"].size(), 1u);
  EXPECT_EQ(result.face_template, nullptr);
  EXPECT_EQ(result.pictures.size(), 3u);
}

TEST(LandmarkPredictor, ReturnsAllFacesAndRefusesPicturesWithoutOne) {
  auto network = std::make_shared<testing::IdealLandmarkNetwork>();
  network->faces = {testing::PlausibleLandmarks(15, 60, 70), testing::PlausibleLandmarks(115, 50, 70)};
  const LandmarkPredictor predictor({}, network);
  const std::vector<systems::Input> inputs = {testing::PictureOfPlaces(200, 200)};
  const systems::FaceResult result = predictor.Predict(inputs).front();
  EXPECT_EQ(result.record["faces"].size(), 2u);
  EXPECT_EQ(result.warnings.size(), 1u);
  network->faces.clear();
  testing::ExpectError([&] { predictor.Predict(inputs); }, "no face found");
  testing::ExpectError([&] { predictor.Predict(std::vector<systems::Input>{render::Drawing{}}); }, "is no picture");
}

}  // namespace
}  // namespace daumier::portrait
