#include "faces/source.h"

#include "core/error.h"
#include "tests/faces/import/foreign_face.h"
#include "tests/faces/import/foreign_files.h"
#include "tests/support/expect_error.h"
#include "tests/support/paths.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <set>

namespace daumier::faces {
namespace {

TEST(Source, IctNeedsAPath) {
  EXPECT_THROW(LoadFaceModel({.name = "ict", .path = ""}), UsageError);
}

TEST(Source, MissingPathsAreNamed) {
  testing::ExpectError([] { LoadFaceModel({.name = "ict", .path = "/no/such/ict"}); }, "/no/such/ict");
  testing::ExpectError([] { LoadFaceModel({.name = "makehuman", .path = "/no/such/makehuman"}); },
                       "/no/such/makehuman");
}

TEST(Source, ImportersNeedPathAndAnnotation) {
  for (const char* name :
       {"bfm", "flame", "facescape", "meshes", "facewarehouse", "facewarehouse_poses", "caricshop"}) {
    testing::ExpectError([&] { LoadSource({.name = name}); }, "needs source.path");
    testing::ExpectError([&] { LoadSource({.name = name, .path = "/no/such"}); }, "needs source.annotation");
    testing::ExpectError([&] { LoadSource({.name = name, .path = "/no/such", .annotation = "/no/such.json"}); },
                         "/no/such.json");
  }
}

TEST(Source, MeshesAreFacesAndNoModel) {
  const testing::TempDir folder;
  testing::WriteForeignObj(folder / "bob/a.obj", testing::ForeignMesh());
  WriteFileAtomically(folder / "a.json", testing::ForeignAnnotationJson().dump());
  SourceOptions options{.name = "meshes",
                        .path = folder.path().string(),
                        .annotation = (folder / "a.json").string(),
                        .person = "folder",
                        .licence = "CC0"};
  const auto source = LoadSource(options);
  const auto& given = std::get<GivenFaces>(source);
  EXPECT_EQ(given.groups, std::vector<std::string>{"bob"});
  EXPECT_EQ(given.face_template.provenance.at("licence"), "CC0");
  EXPECT_THROW(LoadFaceModel(options), UsageError);
  EXPECT_EQ(ParseOptions<SourceOptions>(Json::object()).licence, "unknown; set source.licence");
}

TEST(Source, IsRecognisedByItsContent) {
  const testing::TempDir folder;
  EXPECT_EQ(RecognisedSource(testing::SourceRoot() / "weights/face-ict"), "ict");
  EXPECT_EQ(RecognisedSource(folder.path()), std::nullopt);
  testing::WriteNpz(folder / "a.npz", {{"f", ""}, {"v_template", ""}});
  testing::WriteNpz(folder / "b.npz", {{"shape_bm_core", ""}});
  testing::WriteNpz(folder / "c.npz", {{"weights", ""}});
  EXPECT_EQ(RecognisedSource(folder / "a.npz"), "flame");
  EXPECT_EQ(RecognisedSource(folder / "b.npz"), "facescape");
  EXPECT_EQ(RecognisedSource(folder / "c.npz"), std::nullopt);
  EXPECT_EQ(RecognisedSource("generic_model.pkl"), "flame");
  EXPECT_EQ(RecognisedSource("01_MorphableModel.mat"), "bfm");
  EXPECT_EQ(RecognisedSource("model2019_face12.h5"), "bfm");
  EXPECT_EQ(RecognisedSource("ict-facekit.tar.xz"), "ict");
  EXPECT_EQ(RecognisedSource("head.obj"), std::nullopt);
  MakeDirectory(folder / "fw/Tester_7");
  EXPECT_EQ(RecognisedSource(folder / "fw"), "facewarehouse");
  MakeDirectory(folder / "kit/FaceXModel");
  EXPECT_EQ(RecognisedSource(folder / "kit"), "ict");
  MakeDirectory(folder / "human/makehuman/data/3dobjs");
  WriteFileAtomically(folder / "human/makehuman/data/3dobjs/base.obj", "");
  EXPECT_EQ(RecognisedSource(folder / "human"), "makehuman");
}

TEST(Source, OptionsListTheSources) {
  const std::vector<std::string> names = SourceNames();
  EXPECT_EQ(names.front(), SourceOptions().name);
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
  EXPECT_NE(SourcePathHelp().find("bfm, flame, facescape: the file of the model. meshes, "), std::string::npos);
  testing::ExpectError([] { LoadSource({.name = "wax"}); }, "there is no source 'wax' (expected makehuman, ict");
  EXPECT_THROW(ParseOptions<SourceOptions>(Json{{"name", "wax"}}), UsageError);
  EXPECT_EQ(ParseOptions<SourceOptions>(Json{{"name", "ict"}, {"path", "a.tar.xz"}}).path, "a.tar.xz");
}

}  // namespace
}  // namespace daumier::faces
