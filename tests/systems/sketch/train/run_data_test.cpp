#include "systems/sketch/train/run_data.h"

#include "tests/support/expect_error.h"
#include "tests/systems/sketch/train/run_fixture.h"

namespace daumier::sketch {
namespace {

namespace fs = std::filesystem;

using SketchRunDataTest = SketchRunFixture;

TEST_F(SketchRunDataTest, RefusesOtherDataThanTheRunWasTrainedOn) {
  const fs::path run = *folder_ / "other_run";
  WriteRun(run);
  testing::BuildSyntheticFaces(*folder_ / "other_faces", 7);
  Json config = LoadConfig(run / "resolved.toml");
  config["data"]["faces"] = (*folder_ / "other_faces").string();
  WriteFileAtomically(run / "resolved.toml", ToToml(config));
  testing::ExpectError([&] { OpenSketchRunData(run); }, "the faces differ from the training data of");
}

TEST_F(SketchRunDataTest, ReadsDataThatHaveMoved) {
  const fs::path run = *folder_ / "moved_run", moved = *folder_ / "elsewhere";
  WriteRun(run);
  Json config = LoadConfig(run / "resolved.toml");
  config["data"] = {{"faces", "/absent/of/f"}, {"sketches", "/absent/of/s"}};
  WriteFileAtomically(run / "resolved.toml", ToToml(config));
  FolderCache databases;
  testing::ExpectError([&] { OpenSketchRunData(run, databases); }, "If they have moved, add data.faces=FOLDER");
  fs::create_directories(moved);
  fs::copy(*folder_ / "faces", moved / "a", fs::copy_options::recursive);
  fs::copy(*folder_ / "sketches", moved / "b", fs::copy_options::recursive);
  const SketchRunData data =
      OpenSketchRunData(run, databases, {.faces = (moved / "a").string(), .sketches = (moved / "b").string()});
  EXPECT_EQ(data.faces.num_faces(), faces::FaceDatabase(*folder_ / "faces").num_faces());
}

TEST_F(SketchRunDataTest, RefusesASplitThatComesOutOtherwise) {
  const fs::path run = *folder_ / "other_split";
  WriteRun(run);
  Manifest manifest = ReadManifest(run, "run");
  manifest.details["split"]["test"]["faces_checksum"] = "0";
  WriteManifest(run, manifest);
  testing::ExpectError([&] { OpenSketchRunData(run); }, "split does not match the run's manifest");
}

}  // namespace
}  // namespace daumier::sketch
