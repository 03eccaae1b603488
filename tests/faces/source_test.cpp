#include "faces/source.h"

#include "core/error.h"
#include "tests/faces/import/foreign_face.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

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

TEST(Source, OptionsListTheSources) {
  EXPECT_THROW(ParseOptions<SourceOptions>(Json{{"name", "wax"}}), UsageError);
  EXPECT_EQ(ParseOptions<SourceOptions>(Json{{"name", "ict"}, {"path", "a.tar.xz"}}).path, "a.tar.xz");
}

}  // namespace
}  // namespace daumier::faces
