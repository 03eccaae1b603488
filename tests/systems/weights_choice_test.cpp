#include "systems/weights_choice.h"

#include "core/error.h"
#include "core/files.h"
#include "core/weights_folder.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::systems {
namespace {

namespace fs = std::filesystem;

/// In these tests a bright picture is a drawing, and a dark one a portrait.
PictureContent BrightPictures() {
  return {"bright pictures", [](const render::Image& picture) { return picture.at(0, 0) / 255.0 - 0.5; }};
}
PictureContent DarkPictures() {
  return {"dark pictures", [](const render::Image& picture) { return 0.5 - picture.at(0, 0) / 255.0; }};
}

class WeightsChoiceTest : public ::testing::Test {
 protected:
  WeightsChoiceTest() {
    Add("portrait", {".png", ".jpg"}, 2, DarkPictures());
    Add("landmarks", {".png", ".jpg"}, 1, DarkPictures());
    Add("sketch", {".svg", ".png"}, 0, BrightPictures());
    WritePicture("dark.png", 20);
    WritePicture("bright.png", 240);
    WriteFileAtomically(folder_ / "face.svg", "<svg/>");
  }
  void Add(std::string_view name, std::vector<std::string> extensions, int rank, const PictureContent& content) {
    System system{};
    system.name = name;
    system.input_extensions = std::move(extensions);
    system.shipped_rank = rank;
    system.picture_content = content;
    system.open = [](const fs::path&, const Device&, const Json&) { return std::unique_ptr<Predictor>(); };
    systems_.push_back(system);
  }
  void WritePicture(const fs::path& name, uint8_t grey) const {
    render::WriteImage(folder_ / name, render::Image(4, 4, 1, grey));
  }
  void Ship(const std::string& name, const std::string& system) const {
    MakeDirectory(folder_ / "weights" / name);
    Manifest manifest{.kind = kWeightsKind, .verb = "export"};
    manifest.details = {{"system", system}};
    WriteManifest(folder_ / "weights" / name, manifest);
  }
  std::vector<WeightsChoice> For(const std::vector<std::string>& names) const {
    std::vector<fs::path> inputs;
    for (const std::string& name : names) inputs.push_back(folder_ / name);
    const std::vector<fs::path> places{folder_ / "weights"};
    return ChooseWeights(inputs, systems_, ListWeights(places), places);
  }
  /// The name of the one choice for one input.
  std::string NameFor(const std::string& name) const {
    const auto choices = For({name});
    return choices.size() == 1 ? choices[0].weights.filename().string() : "several";
  }

  const testing::TempDir folder_;
  std::vector<System> systems_;
};

TEST_F(WeightsChoiceTest, ContentDoesNotCountWhereOneTaskReadsPictures) {
  Ship("portrait", "portrait");
  Ship("landmarks", "landmarks");
  for (const char* name : {"bright.png", "dark.png"}) EXPECT_EQ(NameFor(name), "portrait") << name;
  const auto choices = For({"bright.png", "dark.png"});
  ASSERT_EQ(choices.size(), 1U);
  EXPECT_EQ(choices[0].num_pictures, 0);
  EXPECT_EQ(choices[0].inputs.size(), 2U);
}

TEST_F(WeightsChoiceTest, PicturesGoToTheTaskThatTheySuit) {
  Ship("portrait", "portrait");
  Ship("landmarks", "landmarks");
  Ship("sketch-ict", "sketch");
  EXPECT_EQ(NameFor("bright.png"), "sketch-ict");
  EXPECT_EQ(NameFor("dark.png"), "portrait") << "of the tasks that suit it equally, that of the larger rank";
  EXPECT_EQ(NameFor("face.svg"), "sketch-ict");
  const auto choice = For({"bright.png", "face.svg"});
  ASSERT_EQ(choice.size(), 1U);
  EXPECT_EQ(choice[0].num_pictures, 1);
  EXPECT_EQ(choice[0].content, "bright pictures");
}

TEST_F(WeightsChoiceTest, MixedInputsAreSplit) {
  Ship("portrait", "portrait");
  Ship("sketch-ict", "sketch");
  const auto choices = For({"dark.png", "bright.png", "face.svg"});
  ASSERT_EQ(choices.size(), 2U);
  EXPECT_EQ(choices[0].weights.filename(), "portrait");
  EXPECT_EQ(choices[0].inputs, std::vector<fs::path>{folder_ / "dark.png"});
  EXPECT_EQ(choices[1].weights.filename(), "sketch-ict");
  EXPECT_EQ(choices[1].inputs, (std::vector<fs::path>{folder_ / "bright.png", folder_ / "face.svg"}));
}

TEST_F(WeightsChoiceTest, FoldersAreSplitToo) {
  Ship("portrait", "portrait");
  Ship("sketch-ict", "sketch");
  MakeDirectory(folder_ / "pictures");
  WritePicture("pictures/a.png", 240);
  WritePicture("pictures/b.png", 20);
  const auto choices = For({"pictures"});
  ASSERT_EQ(choices.size(), 2U);
  EXPECT_EQ(choices[0].inputs, std::vector<fs::path>{folder_ / "pictures/a.png"});
  EXPECT_EQ(choices[1].inputs, std::vector<fs::path>{folder_ / "pictures/b.png"});
}

TEST_F(WeightsChoiceTest, WhatCannotBeReadGoesByRank) {
  Ship("portrait", "portrait");
  Ship("sketch-ict", "sketch");
  WriteFileAtomically(folder_ / "broken.png", "no picture");
  EXPECT_EQ(NameFor("broken.png"), "portrait");
  EXPECT_EQ(NameFor("absent.png"), "portrait");
}

TEST_F(WeightsChoiceTest, AnInputThatNoneReadsIsNamed) {
  Ship("portrait", "portrait");
  Ship("sketch-ict", "sketch");
  testing::ExpectError([&] { For({"bright.png", "letter.txt"}); }, "no shipped weights read ");
  testing::ExpectError([&] { For({"letter.txt"}); }, "letter.txt");
}

}  // namespace
}  // namespace daumier::systems
