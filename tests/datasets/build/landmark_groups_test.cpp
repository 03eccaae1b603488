#include "datasets/build/landmark_groups.h"

#include "tests/support/synthetic_face.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

namespace daumier::datasets {
namespace {

using geometry::Vector3;

/// The landmarks of the synthetic face, turned, scaled and moved.
class LandmarkGroups : public ::testing::Test {
 protected:
  LandmarkGroups() {
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.4, Vector3(1, 2, 3).normalized()).toRotationMatrix();
    for (size_t l = 0; l < landmarks_.size(); ++l)
      landmarks_[l] = 3 * turn * face_.neutral.row(face_.annotation.landmarks[l]).transpose() + Vector3(5, 6, 7);
  }
  FitInput Input() const { return {face_, mesh_, landmarks_, shifted_, 0.1}; }
  void Apply(const GroupOrder& order) {
    const MeshLandmarks given = landmarks_;
    for (size_t k = 0; k < order.landmarks.size(); ++k)
      landmarks_[size_t(order.landmarks[k])] = given[size_t(order.sources[k])];
  }

  const faces::FaceTemplate face_ = testing::SyntheticFace();
  const geometry::TriangleMesh mesh_{face_.neutral, face_.triangles};
  MeshLandmarks landmarks_;
  const ShiftedNumbers shifted_;
};

TEST_F(LandmarkGroups, OrdersAreTheirOwnInverse) {
  for (const GroupOrder& order : GroupOrders()) {
    ASSERT_EQ(order.landmarks.size(), order.sources.size()) << order.fault;
    for (size_t k = 0; k < order.landmarks.size(); ++k) {
      const auto back = std::find(order.landmarks.begin(), order.landmarks.end(), order.sources[k]);
      ASSERT_NE(back, order.landmarks.end()) << order.fault;
      EXPECT_EQ(order.sources[size_t(back - order.landmarks.begin())], order.landmarks[k]) << order.fault;
      EXPECT_NE(order.sources[k], order.landmarks[k]) << order.fault;
    }
  }
}

TEST_F(LandmarkGroups, EveryOrderIsNamed) {
  EXPECT_FALSE(FaultOfGroups(Input(), 0.7));
  for (const GroupOrder& order : GroupOrders()) {
    Apply(order);
    const auto fit = FitOfGroup(Input(), order);
    ASSERT_TRUE(fit) << order.fault;
    EXPECT_GT(fit->given, 0.05) << order.fault;
    EXPECT_NEAR(fit->changed, 0, 1e-6) << order.fault;
    EXPECT_EQ(FaultOfGroups(Input(), 0.7).value_or("").find(order.fault), 0u) << order.fault;
    Apply(order);
  }
}

TEST_F(LandmarkGroups, SeveralAreNamedTogether) {
  Apply(GroupOrders()[0]);
  Apply(GroupOrders()[4]);
  const std::string fault = FaultOfGroups(Input(), 0.7).value_or("");
  EXPECT_NE(fault.find("the eyes are exchanged"), std::string::npos) << fault;
  EXPECT_NE(fault.find("; "), std::string::npos) << fault;
  EXPECT_NE(fault.find("the jaw is reversed"), std::string::npos) << fault;
}

TEST_F(LandmarkGroups, AbsentOnesAreLeftOut) {
  Apply(GroupOrders()[0]);
  landmarks_[36].reset();
  EXPECT_TRUE(FaultOfGroups(Input(), 0.7));
  for (size_t l = 36; l < 41; ++l) landmarks_[l].reset();
  EXPECT_FALSE(FitOfGroup(Input(), GroupOrders()[0]));
}

TEST_F(LandmarkGroups, OutliersAreThoseFarAboveAllOthers) {
  EXPECT_TRUE(Outliers(Input()).empty());
  *landmarks_[40] += Vector3(0, 0, 90);
  EXPECT_EQ(Outliers(Input()), std::vector<int>{40});
  *landmarks_[3] += Vector3(90, 0, 0);
  EXPECT_EQ(Outliers(Input()), (std::vector<int>{3, 40}));
}

}  // namespace
}  // namespace daumier::datasets
