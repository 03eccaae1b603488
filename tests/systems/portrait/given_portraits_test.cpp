#include "systems/portrait/given_portraits.h"

#include "core/manifest.h"
#include "datasets/read/portrait_database.h"
#include "systems/portrait/landmark_jaw.h"
#include "systems/portrait/portrait_crop.h"
#include "tests/support/cancelled_task.h"
#include "tests/support/expect_error.h"
#include "tests/support/given_pictures.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <cmath>

namespace daumier::portrait {
namespace {

namespace fs = std::filesystem;

using testing::MarkedPicture;
using testing::MarkedPictureNetwork;
using testing::PictureOfPlaces;

const Json kNetwork = {{"weights", "w"}};

GivenPortraits Build(const fs::path& pictures, const fs::path& out, const GivenPortraitsOptions& options = {},
                     const Task& task = {}) {
  return BuildGivenPortraits(testing::GivenDetector(), kNetwork, pictures, options, out, task);
}

TEST(GivenPortraits, AreCropsOfTheFacesWithLandmarksMasksAndPersons) {
  const testing::TempDir folder;
  testing::WriteGivenPictures(folder / "in");
  const GivenPortraits made = Build(folder / "in", folder / "out", {.licence = "mine"});
  EXPECT_EQ(made.num_portraits, 3);
  EXPECT_TRUE(made.dropped.empty());
  const datasets::PortraitDatabase database(folder / "out");
  ASSERT_EQ(database.size(), 3);
  EXPECT_FALSE(database.has_known_faces());
  EXPECT_EQ(database.image_size(), kPortraitSide);
  EXPECT_EQ(database.person(1), database.person(2));
  EXPECT_NE(database.person(0), database.person(1));
  EXPECT_EQ(database.manifest().sources.at(0).at("licence"), "mine");
  const PictureMap map = CropOfLandmarks(testing::GivenFace(), 0.5);
  const std::vector<float> expected = MapLandmarks(EvenJaw(testing::GivenFace()), map),
                           landmarks = database.landmarks(0);
  for (size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(landmarks[i], expected[i], 1.5);
  EXPECT_EQ(database.visibility(0), std::vector<uint8_t>(68, 1));
  // A pixel of the crop shows the place of the picture from which it comes, as the red and the green show it.
  const render::Image picture = database.picture(0);
  const Eigen::Vector2d from = map.Inverse()({100.5, 120.5});
  EXPECT_NEAR(picture.at(120, 100, 0), from.x(), 6);
  EXPECT_NEAR(picture.at(120, 100, 1), from.y(), 6);
  // Landmarks 36 and 39 are the corners of an eye: between them is one.
  const render::Image mask = database.mask(0);
  const int x = int(landmarks[72] + landmarks[78]) / 2, y = int(landmarks[73] + landmarks[79]) / 2;
  EXPECT_EQ(mask.at(y, x), uint8_t(PictureClass::kEyes));
  EXPECT_EQ(mask.at(y + 30, x), uint8_t(PictureClass::kSkin));
  for (const float number : database.expression(0)) EXPECT_EQ(number, 0);
}

TEST(GivenPortraits, WhatIsNotKeptIsListedWithItsCause) {
  const testing::TempDir folder;
  const fs::path in = folder / "in";
  MakeDirectory(in / "more");
  render::WriteImage(in / "a.png", PictureOfPlaces(200, 200));
  render::WriteImage(in / "b.png", MarkedPicture(200, 200, MarkedPictureNetwork::kDoubtful));
  render::WriteImage(in / "c.png", MarkedPicture(200, 200, MarkedPictureNetwork::kEmpty));
  WriteFileAtomically(in / "d.jpg", "no picture");
  render::WriteImage(in / "more/e.png", PictureOfPlaces(200, 200));
  WriteFileAtomically(in / "more/e.pts", "1 2\n3 4\n");
  WriteFileAtomically(in / "notes.txt", "not a picture");
  const GivenPortraits made = Build(in, folder / "out");
  EXPECT_EQ(made.num_pictures, 5);
  EXPECT_EQ(made.num_portraits, 1);
  ASSERT_EQ(made.dropped.size(), 4u);
  const std::vector<std::pair<std::string, std::string>> expected = {{"b.png", "a face of confidence 0.6"},
                                                                     {"c.png", "no face"},
                                                                     {"d.jpg", "not a readable picture"},
                                                                     {"more/e.png", "more/e.pts: "}};
  for (size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(made.dropped[i].file, expected[i].first);
    EXPECT_NE(made.dropped[i].cause.find(expected[i].second), std::string::npos) << made.dropped[i].cause;
    EXPECT_EQ(made.dropped[i].cause.find(folder.path().string()), std::string::npos) << made.dropped[i].cause;
  }
  const Json rows = ReadJson(folder / "out/pictures.json").at("pictures");
  EXPECT_EQ(rows[0].at("portraits"), Json::array({0}));
  EXPECT_GT(rows[0].at("confidences")[0].get<double>(), 0.9);
  // The doubtful face is kept by a lower threshold.
  GivenPortraitsOptions options;
  options.detector.least_confidence = 0.5;
  auto network = std::make_shared<MarkedPictureNetwork>();
  network->faces = {testing::GivenFace()};
  EXPECT_EQ(BuildGivenPortraits({{}, network, options.detector}, kNetwork, in, options, folder / "lax").num_portraits,
            2);
}

TEST(GivenPortraits, FilesNextToAPictureTakeThePlaceOfTheNetworks) {
  const testing::TempDir folder;
  const fs::path in = folder / "in";
  MakeDirectory(in);
  // The network is not sure of the face, but its landmarks are given.
  render::WriteImage(in / "a.png", MarkedPicture(200, 200, MarkedPictureNetwork::kDoubtful));
  const std::vector<float> given = testing::PlausibleLandmarks(70, 60, 60);
  WriteFileAtomically(in / "a.pts", LandmarksAsPts(given));
  render::WriteImage(in / "a_mask.png", render::Image(200, 200, 1, 6));
  render::WriteImage(in / "b_mask.png", PictureOfPlaces(200, 200));  // A picture: there is no b.
  EXPECT_EQ(PicturesBelow(in), (std::vector<fs::path>{"a.png", "b_mask.png"}));
  const GivenPortraits made = Build(in, folder / "out", {.size = 0.6});
  EXPECT_EQ(made.num_portraits, 2);
  const datasets::PortraitDatabase database(folder / "out");
  const std::vector<float> expected = MapLandmarks(given, CropOfLandmarks(given, 0.6)),
                           landmarks = database.landmarks(0);
  for (size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(landmarks[i], expected[i], 0.01);
  EXPECT_EQ(database.mask(0), render::Image(kPortraitSide, kPortraitSide, 1, 6));
}

TEST(GivenPortraits, LandmarksAreSeenWhereTheyAreConfidentAndInThePortrait) {
  const testing::TempDir folder;
  testing::WriteGivenPictures(folder / "in");
  Build(folder / "in", folder / "large",
        {.size = 1});  // The box is as high as the portrait, and a little below its middle.
  const std::vector<uint8_t> in_portrait = datasets::PortraitDatabase(folder / "large").visibility(0);
  EXPECT_EQ(in_portrait[8], 0);   // The chin.
  EXPECT_EQ(in_portrait[30], 1);  // The tip of the nose.
  auto network = std::make_shared<MarkedPictureNetwork>();
  network->faces = {testing::GivenFace()};
  network->deviation = 4;
  GivenPortraitsOptions options;
  options.detector.least_confidence = 0;
  const LandmarkDetector vague({}, network, options.detector);
  BuildGivenPortraits(vague, kNetwork, folder / "in", options, folder / "vague");
  EXPECT_EQ(datasets::PortraitDatabase(folder / "vague").visibility(0), std::vector<uint8_t>(68, 0));
  options.seen = 0;
  BuildGivenPortraits(vague, kNetwork, folder / "in", options, folder / "all");
  EXPECT_EQ(datasets::PortraitDatabase(folder / "all").visibility(0), std::vector<uint8_t>(68, 1));
}

TEST(GivenPortraits, LandmarksOutsideOfThePictureAreACause) {
  const testing::TempDir folder;
  testing::WriteGivenPictures(folder / "in");
  WriteFileAtomically(folder / "in/alone.pts", LandmarksAsPts(testing::PlausibleLandmarks(500, 60, 60)));
  const GivenPortraits made = Build(folder / "in", folder / "out");
  ASSERT_EQ(made.dropped.size(), 1u);
  EXPECT_NE(made.dropped[0].cause.find("outside of the picture of 200 x 200"), std::string::npos);
}

TEST(GivenPortraits, AllFacesOfAPictureAreKept) {
  const testing::TempDir folder;
  MakeDirectory(folder / "in");
  render::WriteImage(folder / "in/pair.png", PictureOfPlaces(200, 200));
  auto network = std::make_shared<MarkedPictureNetwork>();
  network->faces = {testing::PlausibleLandmarks(15, 60, 70), testing::PlausibleLandmarks(115, 50, 70)};
  const LandmarkDetector detector({}, network, GivenPortraitsOptions().detector);
  const GivenPortraits made = BuildGivenPortraits(detector, kNetwork, folder / "in", {}, folder / "out");
  EXPECT_EQ(made.num_portraits, 2);
  EXPECT_EQ(ReadJson(folder / "out/pictures.json")["pictures"][0]["portraits"], Json::array({0, 1}));
  const datasets::PortraitDatabase database(folder / "out");
  EXPECT_EQ(database.person(0), database.person(1));
}

/// 40 pictures, of which the first 20 have no face: three shards, of which the first is empty.
void WriteManyPictures(const fs::path& folder) {
  MakeDirectory(folder);
  for (int i = 0; i < 40; ++i)
    render::WriteImage(folder / fmt::format("{:02}.png", i),
                       MarkedPicture(100 + i, 200, i < 20 ? MarkedPictureNetwork::kEmpty : 0));
}

std::map<std::string, std::string> ContentOf(const fs::path& folder) {
  std::map<std::string, std::string> content;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) content[entry.path().lexically_relative(folder).string()] = ReadFile(entry.path());
  return content;
}

TEST(GivenPortraits, AnInterruptedBuildGivesTheSameBytesAndAFinishedOneStays) {
  const testing::TempDir folder;
  WriteManyPictures(folder / "in");
  const GivenPortraits made = Build(folder / "in", folder / "whole");
  EXPECT_EQ(made.num_portraits, 20);
  const auto whole = ContentOf(folder / "whole");
  EXPECT_EQ(datasets::PortraitDatabase(folder / "whole").size(), 20);
  EXPECT_EQ(whole.count("shards/portraits-00002.safetensors"), 0u);
  std::stop_source stop;
  const Task task(stop.get_token(), [&](const TaskProgress& progress) {
    if (progress.done > 0) stop.request_stop();
  });
  testing::ExpectError([&] { Build(folder / "in", folder / "parts", {}, task); }, "resumes the build");
  EXPECT_FALSE(fs::exists(folder / "parts/manifest.json"));
  Build(folder / "in", folder / "parts");
  EXPECT_EQ(ContentOf(folder / "parts"), whole);
  EXPECT_EQ(Build(folder / "in", folder / "parts").dropped.size(), 20u);  // It is only verified.
  EXPECT_EQ(ContentOf(folder / "parts"), whole);
}

TEST(GivenPortraits, OfOtherPicturesOrOptionsAreRefusedInTheSameFolder) {
  const testing::TempDir folder;
  testing::WriteGivenPictures(folder / "in");
  Build(folder / "in", folder / "out");
  testing::ExpectError([&] { Build(folder / "in", folder / "out", {.size = 0.6}); }, "config/size is 0.5 there");
  WriteFileAtomically(folder / "in/alone.pts", LandmarksAsPts(testing::GivenFace()));
  testing::ExpectError([&] { Build(folder / "in", folder / "out"); }, "sources/0/checksum");
  MakeDirectory(folder / "notes");
  WriteFileAtomically(folder / "notes/a.txt", "mine");
  testing::ExpectError([&] { Build(folder / "in", folder / "notes"); }, "notes");
  EXPECT_EQ(ContentOf(folder / "notes").size(), 1u);
}

TEST(GivenPortraits, FoldersWithoutPicturesOrFacesAreRefusedAndLeaveNothing) {
  const testing::TempDir folder;
  MakeDirectory(folder / "empty");
  testing::ExpectError([&] { Build(folder / "absent", folder / "out"); }, "absent is no folder of pictures");
  testing::ExpectError([&] { Build(folder / "empty", folder / "out"); }, "holds no picture (expected files .png");
  MakeDirectory(folder / "in");
  render::WriteImage(folder / "in/c.png", MarkedPicture(200, 200, MarkedPictureNetwork::kEmpty));
  testing::ExpectError([&] { Build(folder / "in", folder / "out"); }, "none of 1 pictures has a face that is kept");
  EXPECT_FALSE(fs::exists(folder / "out"));
  testing::ExpectError([&] { BuildGivenPortraits(folder / "in", {}, folder / "out"); }, "need landmark_run=RUN");
}

}  // namespace
}  // namespace daumier::portrait
