#include "systems/portrait/landmark_files.h"

#include "core/files.h"
#include "systems/portrait/landmark_errors.h"
#include "systems/portrait/landmark_metrics.h"
#include "systems/portrait/landmark_predictor.h"
#include "systems/portrait/landmark_report.h"
#include "systems/portrait/landmark_split.h"
#include "systems/portrait/system.h"
#include "tests/support/drawn_portraits.h"
#include "tests/support/expect_error.h"
#include "tests/support/ideal_landmark_network.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <set>

namespace daumier::portrait {
namespace {

TEST(LandmarkFiles, ReadPtsUndoesWritingAndTextMayBeginWithTheCount) {
  const testing::TempDir folder;
  const std::vector<float> truth = testing::PlausibleLandmarks(10, 20, 60);
  WriteFileAtomically(folder / "a.pts", LandmarksAsPts(truth));
  std::string text = "68\n";
  for (size_t i = 0; i < truth.size(); i += 2) text += fmt::format("{} {}\n", truth[i], truth[i + 1]);
  WriteFileAtomically(folder / "b.txt", text);
  for (const char* name : {"a.pts", "b.txt"}) {
    const std::vector<float> read = ReadLandmarks(folder / name);
    for (size_t i = 0; i < truth.size(); ++i) EXPECT_NEAR(read[i], truth[i], 6e-4);
  }
  WriteFileAtomically(folder / "c.txt", "1 2\n3 4\n");
  testing::ExpectError([&] { ReadLandmarks(folder / "c.txt"); }, "has 2 points");
}

TEST(LandmarkFiles, AMaskHasThePicturesSizeAndClasses) {
  const testing::TempDir folder;
  render::WriteImage(folder / "m.png", render::Image(8, 9, 1, 7));
  EXPECT_EQ(ReadMask(folder / "m.png", 8, 9).at(3, 3), 7);
  testing::ExpectError([&] { ReadMask(folder / "m.png", 9, 8); }, "expected a grey picture of 9 x 8");
  render::WriteImage(folder / "n.png", render::Image(8, 9, 1, 8));
  testing::ExpectError([&] { ReadMask(folder / "n.png", 8, 9); }, "a pixel of class 8, expected 0 to 7");
}

TEST(LandmarkPredictor, GivenLandmarksAndMaskTakeThePlaceOfTheNetworks) {
  const testing::TempDir folder;
  const std::vector<float> given = testing::PlausibleLandmarks(61, 52, 80);
  WriteFileAtomically(folder / "face.pts", LandmarksAsPts(given));
  render::WriteImage(folder / "mask.png", render::Image(200, 200, 1, 1));
  auto network = std::make_shared<testing::IdealLandmarkNetwork>();
  network->faces = {testing::PlausibleLandmarks(60, 50, 80)};
  const LandmarkPredictor predictor({}, network,
                                    {.landmarks = (folder / "face.pts").string(), .mask = (folder / "mask.png").string()});
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

TEST(NormalisedError, IsTheMeanDistanceOverThatOfTheEyeCorners) {
  std::vector<float> truth(136, 0), points = truth;
  truth[72] = points[72] = 10;
  truth[90] = points[90] = 60;
  points[0] = 3;
  points[1] = 4;  // Landmark 0 misses by 5 pixels.
  EXPECT_NEAR(NormalisedError(points, truth), 5.0 / 50 / 68, 1e-9);
  EXPECT_NEAR(NormalisedError(points, truth, 0, 17), 5.0 / 50 / 17, 1e-9);
  EXPECT_EQ(NormalisedError(points, truth, 36, 48), 0);
  testing::ExpectError([&] { NormalisedError(truth, std::vector<float>(136, 0)); }, "are one point");
}

TEST(LabelCounts, AreIntersectionAndUnionOfKnownPixels) {
  LabelCounts counts;
  counts.Add(std::vector<int64_t>{1, 1, 0, 3}, std::vector<int64_t>{1, 0, 0, -100});
  EXPECT_DOUBLE_EQ(counts.iou(FaceClass::kSkin), 0.5);
  EXPECT_DOUBLE_EQ(counts.iou(FaceClass::kBackground), 0.5);
  EXPECT_DOUBLE_EQ(counts.iou(FaceClass::kEye), 1);
}

TEST(SplitSamples, KeepsPersonsTogether) {
  const testing::DrawnPortraits source(40);
  const datasets::Split split = SplitSamples(source, {.validation = 0.1, .test = 0.2}, 3);
  EXPECT_EQ(split.test.size(), 8u);
  EXPECT_EQ(split.validation.size(), 4u);
  EXPECT_EQ(split.train.size(), 28u);
  std::set<int> persons;
  for (const int i : split.test) persons.insert(source.person(i));
  for (const int i : split.train) EXPECT_FALSE(persons.contains(source.person(i)));
  testing::ExpectError([] { SplitSamples(testing::DrawnPortraits(2), {}, 1); }, "too few");
}

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

TEST(LandmarkSystem, ResolvesItsOptionsAndRefusesUnknownOnes) {
  const systems::System system = LandmarkSystem();
  const Json resolved = system.resolve_config({{"system", "landmarks"}, {"data", {{"portraits", "p"}}}}, "c.toml");
  EXPECT_EQ(resolved["network"]["resolution"], 128);
  EXPECT_EQ(system.resolve_config(resolved, "c.toml"), resolved);
  EXPECT_EQ(system.resolve_evaluation(Json::object(), "eval")["split"], "test");
  EXPECT_EQ(system.resolve_prediction(Json::object(), "predict")["detector"]["rounds"], 2);
  testing::ExpectError([&] { system.resolve_prediction({{"landmark", "x"}}, "predict"); }, "unknown key 'landmark'");
  testing::ExpectError([&] { system.resolve_evaluation({{"rival", "x"}}, "eval"); }, "rival needs pictures");
}

TEST(LandmarkMetrics, ATableSurvivesJson) {
  reports::MetricTable table{.columns = LandmarkColumns(), .faces = {3, 4}, .groups = {1, 2}, .data_hash = {{"portraits", "x"}}};
  reports::FaceValues values;
  for (const char* key : {"error", "jaw", "brows", "nose", "eyes", "mouth"}) values[key] = {0.02, 0.04};
  table.rows.push_back(reports::MakeRow(table, "network", values, 1));
  const Json metrics = {{"table", reports::TableJson(table)}, {"faces", table.faces}, {"groups", table.groups}, {"data_hash", table.data_hash}};
  const reports::MetricTable read = ReadLandmarkMetrics(metrics);
  EXPECT_NEAR(read.rows[0].error().mean, 0.03, 1e-12);
  testing::ExpectError([] { ReadLandmarkMetrics(Json::object()); }, "malformed");
}

}  // namespace
}  // namespace daumier::portrait
