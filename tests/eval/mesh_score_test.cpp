#include "eval/mesh_score.h"

#include "core/files.h"
#include "geometry/obj.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_face.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::eval {
namespace {

using testing::ExpectError;
using testing::TempDir;

geometry::Points Shifted(geometry::Points vertices, double x) {
  vertices.col(0).array() += x;
  return vertices;
}

/// Two imported persons, two levels, two expressions: face f is the neutral one, f cm to the side.
struct ShiftedFaces {
  ShiftedFaces() {
    MakeDirectory(directory / "shards");
    Manifest manifest{.kind = "faces", .verb = "dataset faces"};
    manifest.counts = {{"persons", 2}, {"levels", 2}, {"expressions", 2}};
    manifest.details = {{"gammas", {0.0, 0.2}}, {"expressions", {"neutral", "smile"}}, {"names", {"Bob/C1", "Eve"}}};
    manifest.checksums = faces::WriteFaceTemplate(directory.path(), face);
    for (int person = 0; person < 2; ++person) {
      std::vector<float> vertices;
      for (int index = 4 * person; index < 4 * person + 4; ++index) {
        const geometry::Points points = Shifted(face.neutral, index);
        vertices.insert(vertices.end(), points.data(), points.data() + points.size());
      }
      SafetensorsWriter writer;
      writer.Add<float>("vertices", {2, 2, face.num_vertices(), 3}, vertices);
      writer.Add<float>("identity_weights", {1}, std::vector<float>{0});
      manifest.checksums[faces::PersonShardName(person)] = writer.Write(directory / faces::PersonShardName(person));
    }
    WriteManifest(directory.path(), manifest);
  }
  void Write(const std::filesystem::path& file, double x) const {
    geometry::WriteObj(file, faces::SurfaceMesh(face, Shifted(face.neutral, x)));
  }

  const faces::FaceTemplate face = testing::SyntheticFace();
  const TempDir directory;
};

TEST(ScoreMesh, AShiftOfACentimetreIsTheScaleAndVanishesAfterSimilarity) {
  const faces::FaceTemplate face = testing::SyntheticFace();
  const double mm_per_cm = faces::MillimetresPerCm(face);
  const MeshScore score = ScoreMesh("a", Shifted(face.neutral, 1), face.neutral, face);
  EXPECT_NEAR(score.all, mm_per_cm, 1e-9);
  EXPECT_NEAR(score.face, mm_per_cm, 1e-9);
  EXPECT_NEAR(score.p90, mm_per_cm, 1e-9);
  EXPECT_NEAR(score.aligned, 0, 1e-9);
}

TEST(ScoreMesh, TheRegionIsTheFace) {
  const faces::FaceTemplate face = testing::SyntheticFace();
  const auto& region = face.annotation.regions.at("face");
  geometry::Points predicted = Shifted(face.neutral, 2);
  for (const int vertex : region) predicted.row(vertex) = face.neutral.row(vertex);
  const MeshScore score = ScoreMesh("a", predicted, face.neutral, face);
  const double share = 1 - double(region.size()) / face.num_vertices();
  EXPECT_NEAR(score.face, 0, 1e-9);
  EXPECT_NEAR(score.all, 2 * share * faces::MillimetresPerCm(face), 1e-9);
  ExpectError([&] { ScoreMesh("a", predicted.topRows(5), face.neutral, face); }, "a: 5 predicted vertices");
}

TEST(FaceNamed, KnowsIndicesPlacesAndImportedPersons) {
  const ShiftedFaces shifted;
  const faces::FaceDatabase database(shifted.directory.path());
  EXPECT_EQ(FaceNamed(database, "face-00005"), 5);
  EXPECT_EQ(FaceNamed(database, "person-00001-level-2-smile"), 7);
  EXPECT_EQ(FaceNamed(database, "Bob-C1"), 0);
  EXPECT_EQ(FaceNamed(database, "Eve"), 4);
  for (const char* name :
       {"face-00008", "face-5", "face-00005x", "person-00001-level-3-smile", "person-00001-level-0-smile",
        "person-00002-level-1-smile", "person-00001-level-2-frown", ""})
    EXPECT_FALSE(FaceNamed(database, name).has_value()) << name;
}

TEST(ScoreMeshes, ComparesWithTheFacesOfADatabase) {
  const ShiftedFaces shifted;
  const TempDir predictions;
  shifted.Write(predictions / "face-00003.obj", 3.5);
  shifted.Write(predictions / "Eve.obj", 4);
  const faces::FaceDatabase database(shifted.directory.path());
  const auto scores = ScoreMeshes(predictions.path(), database);
  ASSERT_EQ(scores.size(), 2U);
  EXPECT_EQ(scores[0].name, "Eve");
  EXPECT_NEAR(scores[0].face, 0, 1e-4);
  EXPECT_NEAR(scores[1].face, 0.5 * faces::MillimetresPerCm(shifted.face), 1e-4);
  shifted.Write(predictions / "Mallory.obj", 4);
  ExpectError([&] { ScoreMeshes(predictions.path(), database); }, "Mallory.obj: ");
  ExpectError([&] { ScoreMeshes(predictions.path(), database); }, "face-00000 to face-00007 by index");
}

TEST(ScoreMeshes, ComparesWithMeshesOfTheSameName) {
  const ShiftedFaces shifted;
  const TempDir predictions, truth;
  shifted.Write(truth / "bob.obj", 0);
  shifted.Write(truth / "unused.obj", 0);
  shifted.Write(predictions / "bob.obj", 1);
  const auto scores = ScoreMeshes(predictions.path(), truth.path(), shifted.face);
  ASSERT_EQ(scores.size(), 1U);
  EXPECT_NEAR(scores[0].face, faces::MillimetresPerCm(shifted.face), 1e-6);
  shifted.Write(predictions / "bobb.obj", 1);
  ExpectError([&] { ScoreMeshes(predictions.path(), truth.path(), shifted.face); }, "did you mean 'bob'?");
}

TEST(MeshScoresToJson, HasMeanMedianAndPercentileOverFaces) {
  const std::vector<MeshScore> scores = {{.name = "a", .all = 3, .face = 1, .p90 = 2, .aligned = 0.5},
                                         {.name = "b", .all = 3, .face = 2, .p90 = 2, .aligned = 0.5},
                                         {.name = "c", .all = 3, .face = 6, .p90 = 2, .aligned = 0.5}};
  const Json json = MeshScoresToJson(scores);
  EXPECT_EQ(json.at("num_faces"), 3);
  EXPECT_NEAR(json.at("mean_vertex_error_mm").get<double>(), 3, 1e-12);
  EXPECT_NEAR(json.at("median_vertex_error_mm").get<double>(), 2, 1e-12);
  EXPECT_NEAR(json.at("p90_vertex_error_mm").get<double>(), 5.2, 1e-12);
  EXPECT_NEAR(json.at("aligned").at("mean").get<double>(), 0.5, 1e-12);
  EXPECT_EQ(json.at("faces")[2].at("name"), "c");
  EXPECT_EQ(json.at("faces")[2].at("vertex_error_mm"), 6.0);
}

TEST(MeshScoreTable, HasARowANumber) {
  const auto table =
      MeshScoreTable(std::vector<MeshScore>{{.name = "a", .all = 3, .face = 1, .p90 = 2, .aligned = 0.5}});
  ASSERT_EQ(table.rows.size(), 4U);
  EXPECT_EQ(table.rows[0], (std::vector<std::string>{"face region", "1.00", "1.00", "1.00"}));
}

}  // namespace
}  // namespace daumier::eval
