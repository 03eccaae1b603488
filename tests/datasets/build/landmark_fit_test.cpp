#include "datasets/build/landmark_fit.h"

#include "core/random.h"
#include "tests/support/synthetic_face.h"

#include <gtest/gtest.h>

namespace daumier::datasets {
namespace {

using geometry::Vector3;

/// The synthetic face as the mesh of a somewhat different person, elsewhere and in another scale.
class LandmarkFitTest : public ::testing::Test {
 protected:
  LandmarkFitTest() {
    mesh_ = {face_.neutral, face_.triangles};
    for (auto p : mesh_.vertices.rowwise()) {
      p += Eigen::RowVector3d(0.05 * p.y(), -0.1 * p.z(), 0.3 * std::sin(0.3 * p.x()));
      p = 2 * p + Eigen::RowVector3d(1, 30, 4);
    }
    for (size_t l = 0; l < landmarks_.size(); ++l) landmarks_[l] = At(face_.annotation.landmarks[l]);
  }

  Vector3 At(int vertex) const { return mesh_.vertices.row(vertex).transpose(); }
  FitInput Input() const { return {face_, mesh_, landmarks_, shifted_, 0.1}; }
  LandmarkFit Fit() const { return MeasureLandmarkFit(Input()); }
  std::string Fault() const { return FaultOfLandmarks(Input(), Fit(), {}).value_or(""); }
  void ExpectFault(const std::string& part) const {
    EXPECT_NE(Fault().find(part), std::string::npos) << "found: " << Fault();
  }
  void Change(const Eigen::Matrix3d& matrix) {
    for (auto& place : landmarks_) place = matrix * *place;
  }

  const faces::FaceTemplate face_ = testing::SyntheticFace();
  geometry::TriangleMesh mesh_;
  MeshLandmarks landmarks_;
  ShiftedNumbers shifted_;
};

TEST_F(LandmarkFitTest, OfTheTemplateItselfIsExact) {
  mesh_.vertices = face_.neutral;
  for (size_t l = 0; l < landmarks_.size(); ++l) landmarks_[l] = At(face_.annotation.landmarks[l]);
  const LandmarkFit fit = Fit();
  EXPECT_NEAR(fit.misfit, 0, 1e-9);
  EXPECT_NEAR(fit.off_mesh, 0, 1e-12);
  EXPECT_NEAR(fit.normals, 1, 1e-9);
  EXPECT_GT(fit.mirrored.value().misfit, 0.2);
}

TEST_F(LandmarkFitTest, AnotherPersonAndNoiseHaveNoFault) {
  EXPECT_EQ(Fault(), "");
  EXPECT_LT(Fit().misfit, 0.15);
  Rng rng = Stream(1, "noise");
  for (auto& place : landmarks_) *place += 0.5 * Vector3(rng.Normal(), rng.Normal(), rng.Normal());
  EXPECT_EQ(Fault(), "");
  for (int l = 0; l < 17; ++l) landmarks_[size_t(l)].reset();
  EXPECT_EQ(Fault(), "");
}

TEST_F(LandmarkFitTest, OneSideAloneIsNotTakenForTheOther) {
  for (int l = 0; l < 68; ++l) {
    if (l > faces::MirroredLandmark(l)) landmarks_[size_t(l)].reset();
  }
  EXPECT_FALSE(Fit().mirrored);
  EXPECT_EQ(Fault(), "");
}

TEST_F(LandmarkFitTest, LeftAndRightExchanged) {
  const MeshLandmarks given = landmarks_;
  for (int l = 0; l < 68; ++l) landmarks_[size_t(l)] = given[size_t(faces::MirroredLandmark(l))];
  ExpectFault("left and right of the landmarks are exchanged");
}

TEST_F(LandmarkFitTest, YPointsDown) {
  mesh_.vertices.rowwise() -= Eigen::RowVector3d(1, 30, 4);
  for (size_t l = 0; l < landmarks_.size(); ++l) landmarks_[l] = At(face_.annotation.landmarks[l]);
  Change(Vector3(1, -1, 1).asDiagonal());
  ExpectFault("mirrored, y points down: they lie on the mesh as x -y z");
}

TEST_F(LandmarkFitTest, AMirroredMesh) {
  mesh_.vertices.col(0) *= -1;
  Change(Vector3(-1, 1, 1).asDiagonal());
  ExpectFault("the mesh is mirrored and inside out");
  mesh_.triangles.col(0).swap(mesh_.triangles.col(1));
  ExpectFault("or the mesh is a mirror image");
}

TEST_F(LandmarkFitTest, InsideOutIsNoFaultButFacesAway) {
  mesh_.triangles.col(0).swap(mesh_.triangles.col(1));
  EXPECT_EQ(Fault(), "");
  EXPECT_LT(Fit().normals, -0.7);
}

TEST_F(LandmarkFitTest, AnotherUnitOrFrame) {
  const MeshLandmarks given = landmarks_;
  Change(0.01 * Eigen::Matrix3d::Identity());
  ExpectFault("another unit than the mesh: multiply them by 100");
  landmarks_ = given;
  Change(25.4 * Eigen::Matrix3d::Identity());
  ExpectFault("another unit than the mesh: divide them by 25.4");
  landmarks_ = given;
  Change((Eigen::Matrix3d() << 1, 0, 0, 0, 0, -1, 0, 1, 0).finished());  // z up.
  ExpectFault("another frame than the mesh: they lie on it as x z -y");
  landmarks_ = given;
  for (auto& place : landmarks_) *place += Vector3(40, 0, 0);
  ExpectFault("the landmarks are moved by (40, 0, 0) against the mesh");
  landmarks_ = given;
  Change(1.5 * Eigen::Matrix3d::Identity());
  ExpectFault("the landmarks do not lie on the mesh");
}

TEST_F(LandmarkFitTest, NumbersFromOne) {
  shifted_.one_less = landmarks_;
  for (size_t l = 0; l < landmarks_.size(); ++l)
    landmarks_[l] = At(std::min(face_.annotation.landmarks[l] + 1, face_.num_vertices() - 1));
  ExpectFault("1-based");
}

TEST_F(LandmarkFitTest, NumbersThatAreOneTooLow) {
  shifted_.one_more = landmarks_;
  for (size_t l = 0; l < landmarks_.size(); ++l) landmarks_[l] = At(std::max(face_.annotation.landmarks[l] - 1, 0));
  ExpectFault("one too low, as if 1 had been subtracted twice");
  shifted_.one_more = MeshLandmarks();  // None is a vertex.
  EXPECT_EQ(Fault().find("too low"), std::string::npos);
}

TEST_F(LandmarkFitTest, AnotherOrderOfAPartAndSingleOutliers) {
  const MeshLandmarks given = landmarks_;
  for (size_t l = 36; l < 42; ++l) std::swap(landmarks_[l], landmarks_[l + 6]);
  ExpectFault("the eyes are exchanged (36 to 41 with 42 to 47)");
  landmarks_ = given;
  *landmarks_[40] += Vector3(60, 20, 30);
  ExpectFault("landmark 40 is far off");
}

TEST_F(LandmarkFitTest, AllInOnePlace) {
  EXPECT_FALSE(FaultOfOnePlace(landmarks_));
  EXPECT_FALSE(FaultOfOnePlace(MeshLandmarks()));
  for (auto& place : landmarks_) place = Vector3::Zero();
  EXPECT_NE(FaultOfOnePlace(landmarks_).value_or("").find("--zero-is-absent"), std::string::npos);
}

TEST_F(LandmarkFitTest, AllInOnePlaneOfAPictureOrOfAFlatMesh) {
  EXPECT_FALSE(FaultOfPlane(mesh_, landmarks_));
  EXPECT_FALSE(FaultOfPlane(mesh_, MeshLandmarks()));
  const MeshLandmarks given = landmarks_;
  for (const double z : {0.0, -0.0}) {
    for (auto& place : landmarks_) place->z() = z;
    EXPECT_NE(FaultOfPlane(mesh_, landmarks_).value_or("").find("z of all landmarks is 0, but that of the mesh goes"),
              std::string::npos);
  }
  landmarks_ = given;
  for (auto& place : landmarks_) place->y() = 7;
  EXPECT_NE(FaultOfPlane(mesh_, landmarks_).value_or("").find("y of all landmarks is 7"), std::string::npos);
  mesh_.vertices.col(1).setConstant(7);
  EXPECT_NE(FaultOfPlane(mesh_, landmarks_).value_or("").find("the mesh is flat: y of all its points is 7"),
            std::string::npos);
}

TEST_F(LandmarkFitTest, ZerosForAbsentOnes) {
  const MeshLandmarks given = landmarks_;
  for (int l = 0; l < 17; ++l) landmarks_[size_t(l)] = At(0);
  ExpectFault("landmarks 0, 1, 2, 3, 4, 5, ... are 0");
  landmarks_ = given;
  landmarks_[65] = Vector3::Zero();
  ExpectFault("landmarks 65 are 0");
}

TEST_F(LandmarkFitTest, AnotherOrder) {
  const MeshLandmarks given = landmarks_;
  for (size_t l = 0; l < 68; ++l) landmarks_[l] = given[(l + 1) % 68];
  ExpectFault("shifted by one: the one before for each");
  for (size_t l = 0; l < 68; ++l) landmarks_[l] = given[29 * l % 68];
  ExpectFault("not those of a face in iBUG order");
}

}  // namespace
}  // namespace daumier::datasets
