#include "faces/controls/control_table.h"
#include "faces/controls/face_controls.h"
#include "tests/support/synthetic_face.h"

#include <gtest/gtest.h>

namespace daumier::faces {
namespace {

struct MovedBy {
  FaceTemplate face = testing::SyntheticFace();
  FaceControls controls{face};

  geometry::Points operator()(const std::string& name, double value) const {
    Eigen::VectorXd values = Eigen::VectorXd::Zero(controls.num_values());
    for (const auto& entry : controls.entries()) {
      if (entry.control.name == name) values.segment(entry.first_value, entry.num_values()).setConstant(value);
    }
    return controls.Apply(face.neutral, values) - face.neutral;
  }
};

TEST(HeadControls, TheSkullLeavesTheMouthWhereItIs) {
  const MovedBy moved;
  for (const char* name : {"skull_height", "skull_width", "forehead_height", "forehead_slope", "forehead_bulge"}) {
    const geometry::Points motion = moved(name, 3);
    const double most = motion.rowwise().norm().maxCoeff();
    for (int i = 48; i < 68; ++i) EXPECT_LT(motion.row(moved.face.annotation.landmarks[i]).norm(), 0.03 * most) << name;
    EXPECT_GT(most, 1) << name << ": at least a centimetre at its end";
  }
}

TEST(HeadControls, TheJawAndChinLeaveTheEyesWhereTheyAre) {
  const MovedBy moved;
  for (const FaceControl& control : CheekAndChinControls()) {
    if (control.group != "chin" && control.group != "jaw") continue;
    const geometry::Points motion = moved(control.name, 3);
    const double most = motion.rowwise().norm().maxCoeff();
    for (int i = 36; i < 48; ++i)
      EXPECT_LT(motion.row(moved.face.annotation.landmarks[i]).norm(), 0.35 * most) << control.name;
  }
}

TEST(HeadControls, TheWholeFaceIsScaled) {
  const MovedBy moved;
  const geometry::Points wide = moved.face.neutral + moved("face_width", 1);
  const double axis = moved.face.neutral(moved.face.annotation.landmarks[27], 0);
  for (int v = 0; v < wide.rows(); v += 11)
    EXPECT_NEAR(wide(v, 0) - axis, std::exp(0.07) * (moved.face.neutral(v, 0) - axis), 1e-9);
}

TEST(HeadControls, EarsTurnOutAndGrow) {
  const MovedBy moved;
  const auto& ears = moved.face.annotation.regions.at("ears");
  double out = 0;
  const geometry::Points turned = moved("ear_angle", 2), large = moved("ear_size", 2);
  for (const int v : ears) out += (moved.face.neutral(v, 0) > 0 ? 1 : -1) * turned(v, 0);
  EXPECT_GT(out / double(ears.size()), 0.02);
  EXPECT_GT(large(ears, Eigen::all).rowwise().norm().mean(), 0.05);
}

}  // namespace
}  // namespace daumier::faces
