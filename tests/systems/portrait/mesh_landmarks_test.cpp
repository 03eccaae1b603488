#include "systems/portrait/mesh_landmarks.h"

#include "faces/face_model_file.h"
#include "systems/portrait/landmark_predictor.h"
#include "tests/support/expect_error.h"
#include "tests/support/paths.h"

#include <gtest/gtest.h>

#include <set>

namespace daumier::portrait {
namespace {

TEST(HeadOrientations, AreTheTwentyFourRotationsOfTheAxes) {
  std::set<std::vector<double>> rotations;
  std::set<std::string> names;
  for (const HeadOrientation& orientation : HeadOrientations()) {
    const Eigen::Matrix3d& rotation = orientation.upright_from_mesh;
    EXPECT_EQ(rotation.determinant(), 1);
    EXPECT_EQ(rotation * rotation.transpose(), Eigen::Matrix3d::Identity());
    rotations.insert({rotation.data(), rotation.data() + 9});
    names.insert(orientation.name);
  }
  EXPECT_EQ(rotations.size(), 24u);
  EXPECT_EQ(names.size(), 24u);
  EXPECT_EQ(HeadOrientations()[0].upright_from_mesh, Eigen::Matrix3d::Identity());
  EXPECT_EQ(HeadOrientations()[0].name, "y up, the face to +z");
  EXPECT_EQ(HeadOrientations()[4].name, "z up, the face to -y");
}

/// The shipped network on the mean face of the shipped model.
class MeshLandmarks : public ::testing::Test {
 protected:
  MeshLandmarks()
      : face_(faces::ReadFaceModel(testing::SourceRoot() / "weights/face-ict").face_template),
        predictor_(OpenLandmarkPredictor(testing::SourceRoot() / "weights/landmarks", Device(),
                                         ToJson(LandmarkPredictOptions()))) {}

  MeshLandmarkSearch FindOn(const geometry::Points& vertices) const {
    const geometry::Triangles& open = face_.triangles;
    render::RenderInput drawn{.surface = {vertices, open}};
    return FindMeshLandmarks(drawn, face_, dynamic_cast<const LandmarkPredictor&>(*predictor_).detector());
  }
  /// Mean distance from the model's own, without the contour, mm.
  double ErrorOf(const MeshLandmarkSearch& search, const geometry::Points& vertices, double mm) const {
    double sum = 0;
    for (size_t l = 17; l < 68; ++l)
      sum += mm * (search.points[l].position.transpose() - vertices.row(face_.annotation.landmarks[l])).norm() / 51;
    return sum;
  }

  faces::FaceTemplate face_;
  std::unique_ptr<const systems::Predictor> predictor_;
};

TEST_F(MeshLandmarks, LieNearThoseOfTheModel) {
  const MeshLandmarkSearch search = FindOn(face_.neutral);
  EXPECT_EQ(search.orientation.name, "y up, the face to +z");
  EXPECT_GE(search.num_views, 5);
  EXPECT_LT(ErrorOf(search, face_.neutral, 10), 5);
}

TEST_F(MeshLandmarks, AreFoundWhateverTheAxesAndTheUnit) {
  geometry::Points lying(face_.neutral.rows(), 3);
  lying << face_.neutral.col(0), -face_.neutral.col(2), face_.neutral.col(1);
  lying *= 0.01;
  const MeshLandmarkSearch search = FindOn(lying);
  EXPECT_EQ(search.orientation.name, "z up, the face to -y");
  EXPECT_LT(ErrorOf(search, lying, 1000), 5);
}

TEST_F(MeshLandmarks, NeedAFace) {
  geometry::Points flat = face_.neutral;
  flat.col(2).setZero();
  flat.col(1) *= 0.1;
  testing::ExpectError([&] { FindOn(flat); }, "no face was found");
}

}  // namespace
}  // namespace daumier::portrait
