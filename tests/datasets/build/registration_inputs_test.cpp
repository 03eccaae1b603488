#include "datasets/build/registration_inputs.h"

#include "core/files.h"
#include "geometry/obj.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_face.h"
#include "tests/support/temp_dir.h"
#include "tests/support/warnings.h"

#include <gtest/gtest.h>

namespace daumier::datasets {
namespace {

using testing::ExpectError;

class RegistrationInputs : public ::testing::Test {
 protected:
  RegistrationInputs() {
    inputs_ = {{folder_ / "head.obj"}, folder_.path()};
    geometry::WriteObj(inputs_.meshes[0], {face_.neutral, face_.triangles});
    for (const int v : face_.annotation.landmarks) numbers_ += std::to_string(v) + "\n";
  }
  const testing::TempDir folder_;
  const faces::FaceTemplate face_ = testing::SyntheticFace();
  MeshInputs inputs_;
  std::string numbers_;
};

TEST_F(RegistrationInputs, FindLandmarksOfEveryEnding) {
  for (const char* name : {"head.txt", "head.json", "head.pts", "head.pp", "head.csv", "head.tsv", "head.fcsv",
                           "head.mrk.json", "head.xml", "head_picked_points.pp"}) {
    WriteFileAtomically(folder_ / name, numbers_);
    const LandmarkedMesh mesh = ReadLandmarkedMesh(inputs_, 0);
    EXPECT_EQ(mesh.landmark_file, folder_ / name);
    EXPECT_EQ(PresentLandmarks(mesh.landmarks).size(), 68u);
    EXPECT_EQ(PlacesOf(mesh.landmarks).row(3), face_.neutral.row(face_.annotation.landmarks[3]));
    std::filesystem::remove(folder_ / name);
  }
  ExpectError([&] { ReadLandmarkedMesh(inputs_, 0); },
              "there are no landmarks of the mesh head (expected one of head.txt");
}

TEST_F(RegistrationInputs, ACloudOfPointsIsNamed) {
  inputs_.meshes[0] = folder_ / "cloud.ply";
  WriteFileAtomically(folder_ / "cloud.txt", numbers_);
  WriteFileAtomically(inputs_.meshes[0],
                      "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n"
                      "end_header\n1 2 3\n4 5 6\n");
  ExpectError([&] { ReadLandmarkedMesh(inputs_, 0); }, "cloud of points");
}

TEST_F(RegistrationInputs, VerticesThatNoPolygonUsesAreLeftOutAndCarryNoLandmark) {
  testing::AllowWarnings();
  WriteFileAtomically(inputs_.meshes[0], ReadFile(inputs_.meshes[0]) + "v nan nan nan\nv 1e6 0 0\n");
  WriteFileAtomically(folder_ / "head.txt", numbers_);
  const LandmarkedMesh mesh = ReadLandmarkedMesh(inputs_, 0);
  EXPECT_LE(mesh.mesh.vertices.rows(), face_.neutral.rows());
  EXPECT_TRUE(mesh.mesh.vertices.allFinite());
  EXPECT_LT(mesh.mesh.vertices.cwiseAbs().maxCoeff(), 1e5);
  EXPECT_EQ(PlacesOf(mesh.landmarks).row(3), face_.neutral.row(face_.annotation.landmarks[3]));
  WriteFileAtomically(folder_ / "head.txt",
                      std::to_string(face_.neutral.rows()) + "\n" + numbers_.substr(numbers_.find('\n') + 1));
  ExpectError([&] { ReadLandmarkedMesh(inputs_, 0); }, "landmark 0 is a vertex of");
}

TEST_F(RegistrationInputs, TheCheckNamesTheFileOfTheLandmarks) {
  WriteFileAtomically(folder_ / "head.txt", numbers_);
  LandmarkedMesh mesh = ReadLandmarkedMesh(inputs_, 0);
  EXPECT_EQ(CheckAgainst(face_, 0.1, {}, mesh), Winding::kAsStored);
  TurnTriangles(mesh.mesh);
  EXPECT_EQ(CheckAgainst(face_, 0.1, {}, mesh), Winding::kTurned);
  EXPECT_EQ(CheckAgainst(face_, 0.1, {}, mesh), Winding::kAsStored);
  for (auto& place : mesh.landmarks) *place *= 1000;
  ExpectError([&] { CheckAgainst(face_, 0.1, {}, mesh); }, "head.txt: the landmarks are in another unit");
  for (size_t l = 0; l < 68; ++l) mesh.landmarks[l] = geometry::Vector3(double(l), 0, 0);
  ExpectError([&] { CheckAgainst(face_, 0.1, {}, mesh); }, "head.txt: ");
}

}  // namespace
}  // namespace daumier::datasets
