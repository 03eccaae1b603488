#include "datasets/build/given_faces.h"

#include "datasets/build/stats.h"
#include "datasets/read/splits.h"
#include "faces/face_database.h"
#include "tests/faces/import/foreign_face.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <set>

namespace daumier::datasets {
namespace {

using testing::ExpectError;
using testing::ForeignMesh;

/// Six identities of three real persons in two expressions; the second lifts all by 1 cm.
faces::GivenFaces Given(bool regions = true) {
  faces::GivenFiles files;
  files.source = "test";
  files.mesh = ForeignMesh();
  files.names = {"a/1", "a/2", "b/1", "b/2", "c/1", "c/2"};
  files.groups = {"a", "a", "b", "b", "c", "c"};
  files.expressions = {"neutral", "lifted"};
  files.provenance = {{"name", "test"}, {"version", "1"}, {"checksum", ""}, {"licence", "research only"}};
  files.face = [](int identity, int expression) -> geometry::Points {
    geometry::Points points = ForeignMesh(identity).vertices;
    points.col(1).array() += expression;
    return points;
  };
  return faces::ImportGivenFaces(files, testing::ForeignAnnotation(regions));
}

FacesOptions GivenOptions(std::vector<double> gammas) {
  FacesOptions options;
  options.source = {.name = "meshes", .path = "/nowhere"};
  options.exaggeration.gammas = std::move(gammas);
  return options;
}

TEST(BuildGivenFaces, FacesAreThoseGiven) {
  const testing::TempDir folder;
  const faces::GivenFaces given = Given(false);
  BuildGivenFaces(given, GivenOptions({0.0}), folder / "faces");
  const faces::FaceDatabase database(folder / "faces");
  ASSERT_EQ(database.num_faces(), 12);
  for (int face = 0; face < 12; ++face)
    EXPECT_LT((database.points(face) - given.face(face / 2, face % 2)).cwiseAbs().maxCoeff(), 1e-5);
  EXPECT_TRUE(database.identity_weights(3).empty());
}

TEST(BuildGivenFaces, LevelsAreExaggeratedNeutralsPlusTheExpression) {
  const testing::TempDir folder;
  const faces::GivenFaces given = Given();
  const FacesOptions options = GivenOptions({0.0, 0.2});
  BuildGivenFaces(given, options, folder / "faces");
  const faces::FaceDatabase database(folder / "faces");
  const auto levels = faces::Exaggerate(given.face_template, given.face(4, 0), options.exaggeration);
  geometry::Points expected = levels[1];
  expected.col(1).array() += 1;
  EXPECT_LT((database.points(database.index({4, 1, 1})) - expected).cwiseAbs().maxCoeff(), 1e-5);
}

TEST(BuildGivenFaces, LevelsMayBeExaggeratedByParts) {
  const testing::TempDir folder;
  FacesOptions options = GivenOptions({0.0, 0.2});
  options.levels = "parts";
  BuildGivenFaces(Given(), options, folder / "faces");
  const faces::FaceDatabase database(folder / "faces");
  const auto id = [&](int person, int level) { return database.points(database.index({person, level, 0})); };
  EXPECT_GT((id(0, 1) - id(0, 0)).cwiseAbs().maxCoeff(), 0.05);
  EXPECT_TRUE(database.manifest().details.contains("parts"));
  options.num_interpolated = 3;
  EXPECT_THROW(BuildGivenFaces(Given(), options, folder / "more"), UsageError);
}

TEST(BuildGivenFaces, ManifestCarriesLicenceNamesAndGroups) {
  const testing::TempDir folder;
  BuildGivenFaces(Given(), GivenOptions({0.0}), folder / "faces");
  const Manifest manifest = ReadManifest(folder / "faces", "faces");
  EXPECT_EQ(manifest.sources.at(0).at("licence"), "research only");
  EXPECT_EQ(manifest.details.at("names").at(3), "b/2");
  EXPECT_EQ(manifest.details.at("groups").at(3), "b");
  EXPECT_EQ(manifest.config.at("num_persons"), 6);
  EXPECT_EQ(FaceStatistics(folder / "faces").at("licences"), manifest.sources);
}

TEST(BuildGivenFaces, SplitsKeepARealPersonOnOneSide) {
  const testing::TempDir folder;
  BuildGivenFaces(Given(), GivenOptions({0.0}), folder / "faces");
  const faces::FaceDatabase database(folder / "faces");
  for (uint64_t seed = 0; seed < 6; ++seed) {
    const Split split = MakeSplit(database, {.kind = "person", .validation = 0.3, .test = 0.3}, seed);
    std::set<int> tested;
    for (const int face : split.test) tested.insert(database.id(face).person / 2);
    EXPECT_EQ(tested.size(), 1u);
    EXPECT_EQ(split.test.size(), 4u);
  }
}

TEST(BuildGivenFaces, WhatIsMissingIsNamedBeforeAnythingIsWritten) {
  const testing::TempDir folder;
  ExpectError(
      [&] {
        BuildGivenFaces(Given(false), GivenOptions({0.0, 0.2}), folder / "faces");
      },
      "needs the region 'nose'");
  FacesOptions options = GivenOptions({0.0});
  options.expressions = {"neutral", "lifte"};
  ExpectError([&] { BuildGivenFaces(Given(), options, folder / "faces"); }, "did you mean 'lifted'");
  EXPECT_FALSE(std::filesystem::exists(folder / "faces"));
}

TEST(BuildFaces, MeshesOfAFolderBecomeADatabase) {
  const testing::TempDir folder;
  for (const int k : {0, 2, 4}) testing::WriteForeignObj(folder / fmt::format("in/{}.obj", k), ForeignMesh(k));
  WriteFileAtomically(folder / "a.json", testing::ForeignAnnotationJson(false).dump());
  FacesOptions options = GivenOptions({0.0});
  options.source.path = (folder / "in").string();
  options.source.annotation = (folder / "a.json").string();
  options.source.licence = "CC0";
  BuildFaces(options, folder / "faces");
  EXPECT_EQ(faces::FaceDatabase(folder / "faces").num_persons(), 3);
  const std::string manifest = ReadFile(folder / "faces/manifest.json");
  EXPECT_NE(manifest.find("CC0"), std::string::npos);
  EXPECT_EQ(manifest.find(folder.path().string()), std::string::npos);
}

}  // namespace
}  // namespace daumier::datasets
