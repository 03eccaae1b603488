// `daumier avatar` as its users run it.
#include "core/files.h"
#include "core/json.h"
#include "render/image.h"
#include "tests/cli/pipeline.h"
#include "tests/support/glb_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace daumier::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

class AvatarCommand : public ::testing::Test {
 protected:
  std::string In(const std::string& name) const { return (folder_ / name).string(); }
  ProcessResult Avatar(std::vector<std::string> options) const {
    options.insert(options.begin(), {"avatar", portrait_, "--out", In("head.glb"), "avatar.texture.size=128"});
    return Daumier(options);
  }

  const std::string portrait_ = (SourceRoot() / "docs/examples/portraits/boy.jpg").string();
  const TempDir folder_;
};

TEST_F(AvatarCommand, MakesACaricatureInAStyleWithHairAndPicturesOfItsStages) {
  const ProcessResult result =
      Avatar({"--style", "toon", "--caricature", "0.5", "--hair", "auto", "--stages", In("stages"), "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Json facts = Json::parse(result.out);
  EXPECT_EQ(facts.at("hair"), "short");
  EXPECT_EQ(facts.at("caricature"), 0.5);
  for (const char* stage : {"open", "style", "face", "targets", "head", "texture", "files"})
    EXPECT_GT(facts.at("milliseconds").at(stage).get<double>(), 0) << stage;
  for (const char* file : {"01_picture.png", "02_style.png", "03_landmarks.png", "04_parsing.png", "05_coarse.png",
                           "06_overlay.png", "07_texture.png", "08_texture_sources.png", "times.json", "manifest.json"})
    EXPECT_TRUE(fs::exists(folder_ / "stages" / file)) << file;
  EXPECT_NE(render::ReadImage(folder_ / "stages/02_style.png"), render::ReadImage(folder_ / "stages/01_picture.png"));
  const GlbReader head(ReadFile(folder_ / "head.glb"));
  EXPECT_TRUE(head.node("Hair").contains("mesh"));
  // The same again replaces its own files; a folder of another kind is kept.
  fs::create_directory(folder_ / "other");
  WriteFileAtomically(folder_ / "other/notes.txt", "mine");
  const ProcessResult other = Avatar({"--stages", In("other")});
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_EQ(ReadFile(folder_ / "other/notes.txt"), "mine");
}

TEST_F(AvatarCommand, RefusesWhatContradictsItselfOrIsUnknown) {
  WriteFileAtomically(folder_ / "points.pts", "version: 1\n");
  const auto expect_misuse = [&](const std::vector<std::string>& options, const std::string& part) {
    const ProcessResult result = Avatar(options);
    EXPECT_EQ(result.exit_code, 2) << part;
    EXPECT_THAT(result.err, HasSubstr(part));
    EXPECT_FALSE(fs::exists(folder_ / "head.glb"));
  };
  expect_misuse({"--landmarks", In("points.pts"), "face.landmarks=other.pts"}, "both --landmarks and face.landmarks");
  expect_misuse({"--style", "oil"}, "there is no style 'oil'");
  expect_misuse({"--caricature", "3"}, "caricature");
  expect_misuse({"--hair", "mohawk"}, "hair");
  expect_misuse({"--hair", "short", "--hair-colour", "hairy"}, "--hair-colour hairy: is no colour");
  expect_misuse({"--mask", In("nowhere.png")}, "nowhere.png");
  expect_misuse({"--caricature", "nan"}, "--caricature nan");
  expect_misuse({"--stages", In("head.glb")}, "is written there as well");
  expect_misuse({"--hair-colour", "red"}, "there is no hair to colour. Add --hair");
  expect_misuse({"palette.skin=red"}, "boy.jpg is read as a portrait, whose head is painted from it. Leave it out, or");
  expect_misuse({"avatar.toon.eyes=0.2"}, "avatar.toon.eyes: has no effect. Add --style toon");
  expect_misuse({"--style", "toon", "avatar.network.side=256"}, "Add --style FILE.onnx, or leave it out");
  expect_misuse({"avatar.texture.delight=false", "avatar.texture.light_share=1"}, "Leave one of them out");
  const std::string girl = (SourceRoot() / "docs/examples/drawings/girl.svg").string();
  for (const char* option : {"face.fine=false", "avatar.keep_expression=true"}) {
    const ProcessResult drawing = Daumier({"avatar", girl, "--out", In("head.glb"), option});
    EXPECT_EQ(drawing.exit_code, 2) << option;
    EXPECT_THAT(drawing.err, HasSubstr("girl.svg is read as a drawing. Leave it out"));
  }
  const ProcessResult weights = Daumier({"avatar", girl, "--out", In("head.glb"), "--weights", "portrait"});
  EXPECT_EQ(weights.exit_code, 2);
  EXPECT_THAT(weights.err, HasSubstr("--weights: is of portraits"));
  WriteFileAtomically(folder_ / "face.png", ReadFile(portrait_));  // Pictures are read by their content.
  const ProcessResult sheet = Daumier({"avatar", In("face.png"), "--out", In("face.glb")});
  EXPECT_EQ(sheet.exit_code, 2);
  EXPECT_THAT(sheet.err, HasSubstr("face.png, which is an input and would be overwritten. Name another .glb"));
}

TEST_F(AvatarCommand, NamesAMaskThatIsNone) {
  render::WriteImage(folder_ / "mask.png", render::Image(224, 224, 1, 77));
  const ProcessResult result = Avatar({"--mask", In("mask.png")});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, AllOf(HasSubstr("mask.png: has a pixel of the value 77"), HasSubstr("black and white")));
}

}  // namespace
}  // namespace daumier::testing
