#include "faces/controls/control_table.h"
#include "faces/controls/face_controls.h"
#include "tests/support/synthetic_face.h"

#include <gtest/gtest.h>

namespace daumier::faces {
namespace {

/// How far each landmark moves by a control at a value, 68 x 3.
geometry::Points LandmarkMotion(const FaceTemplate& face, const FaceControls& controls, const std::string& name,
                                double value) {
  Eigen::VectorXd values = Eigen::VectorXd::Zero(controls.num_values());
  for (const auto& entry : controls.entries()) {
    if (entry.control.name == name) values.segment(entry.first_value, entry.num_values()).setConstant(value);
  }
  const geometry::Points moved = controls.Apply(face.neutral, values) - face.neutral;
  geometry::Points of_landmarks(68, 3);
  for (int i = 0; i < 68; ++i) of_landmarks.row(i) = moved.row(face.annotation.landmarks[i]);
  return of_landmarks;
}

TEST(FeatureControls, MoveTheirFeatureMoreThanOthers) {
  const FaceTemplate face = testing::SyntheticFace();
  const FaceControls controls(face);
  struct Landmarks {
    std::vector<FaceControl> controls;
    int first, last;
  };
  for (const auto& [rows, first, last] : {Landmarks{NoseControls(), 27, 35}, Landmarks{MouthControls(), 48, 67}}) {
    for (const FaceControl& control : rows) {
      const Eigen::VectorXd moved = LandmarkMotion(face, controls, control.name, 1).rowwise().norm();
      if (control.name == "nose_length") continue;  // It carries the mouth.
      const int count = last - first + 1;
      const double inside = moved.segment(first, count).sum(), outside = moved.sum() - inside;
      EXPECT_GT(inside / count, 1.2 * outside / (68 - count)) << control.name;
    }
  }
}

TEST(FeatureControls, LipsLeaveTheSeamBetweenThem) {
  const FaceTemplate face = testing::SyntheticFace();
  const FaceControls controls(face);
  for (const double value : {-3.0, 3.0}) {
    const geometry::Points upper = LandmarkMotion(face, controls, "upper_lip", value),
                           lower = LandmarkMotion(face, controls, "lower_lip", value);
    for (const int i : {60, 61, 62, 63, 64}) EXPECT_NEAR(upper.row(i).norm(), 0, 1e-9) << i;
    for (const int i : {65, 66, 67}) EXPECT_NEAR(lower.row(i).norm(), 0, 1e-9) << i;
    EXPECT_GT(value * upper(51, 1), 0) << "a full upper lip reaches higher";
    EXPECT_LT(value * lower(57, 1), 0) << "a full lower lip hangs lower";
  }
}

TEST(FeatureControls, EyesOpenAndCloseAboutTheirCentre) {
  const FaceTemplate face = testing::SyntheticFace();
  const FaceControls controls(face);
  const geometry::Points wide = LandmarkMotion(face, controls, "eye_height", 2);
  for (const auto& [upper, lower] : {std::pair{37, 41}, {38, 40}, {43, 47}, {44, 46}})
    EXPECT_GT(wide(upper, 1), wide(lower, 1)) << upper;
}

}  // namespace
}  // namespace daumier::faces
