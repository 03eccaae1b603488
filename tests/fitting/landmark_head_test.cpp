#include "fitting/landmark_head.h"

#include "tests/support/expect_error.h"
#include "tests/support/field_model.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <limits>

namespace daumier::testing {
namespace {

using fitting::PicturePoints;

fitting::ScaledView TurnedView() {
  const Eigen::Matrix3d turn =
      (Eigen::AngleAxisd(-0.2, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitY()))
          .toRotationMatrix();
  return {9, turn, {140, 150}};
}

TEST(LandmarkHead, TheFarCameraSeesWhatTheViewSees) {
  const FieldModel model;
  const geometry::Points& face = model.face_template().neutral;
  const auto [pose, camera] = fitting::FarCameraOf(TurnedView());
  const PicturePoints seen = camera.PlacesOf(fitting::Posed(face, pose)), expected = TurnedView().Project(face);
  // A hundredth of a centimetre.
  EXPECT_LT((seen - expected).cwiseAbs().maxCoeff(), 0.02 * TurnedView().scale);
}

TEST(LandmarkHead, IsAlignedToItsLandmarksInThePicture) {
  const FieldModel model;
  const faces::FaceTemplate& face_template = model.face_template();
  const rig::HeadRig rig(face_template);
  const auto& landmarks = face_template.annotation.landmarks;
  const std::vector<int> vertices(landmarks.begin(), landmarks.end());
  PicturePoints given = TurnedView().Project(face_template.neutral(vertices, Eigen::all));
  given.middleRows(27, 9).col(1).array() += 6;  // The nose is lower.
  given.topRows(17).setConstant(std::numeric_limits<double>::quiet_NaN());
  const fitting::ShownHead head = fitting::ShownHeadOf(rig, face_template, face_template.neutral, TurnedView(), given);
  const fitting::ShownHead plain =
      fitting::ShownHeadOf(rig, face_template, face_template.neutral, TurnedView(),
                           PicturePoints::Constant(68, 2, std::numeric_limits<double>::quiet_NaN()));
  const int tip = int(std::ranges::find(rig.finished_vertices(), landmarks[30]) - rig.finished_vertices().begin());
  const auto miss = [&](const fitting::ShownHead& shown) {
    const geometry::Points point = shown.vertices.row(tip);
    return (shown.camera.PlacesOf(fitting::Posed(point, shown.pose)).row(0) - given.row(30)).norm();
  };
  EXPECT_NEAR(miss(plain), 6, 0.1);
  EXPECT_LT(miss(head), 1.5);
  EXPECT_TRUE(head.light.has_value());
  ExpectError(
      [&] { fitting::ShownHeadOf(rig, face_template, face_template.neutral, TurnedView(), PicturePoints::Zero(5, 2)); },
      "5 landmarks");
}

TEST(LandmarkHead, LandmarksAmongPointsAreThoseOfTheirVertices) {
  const FieldModel model;
  const auto& landmarks = model.face_template().annotation.landmarks;
  const PicturePoints found =
      fitting::LandmarksAmong(model.face_template(), {{landmarks[30], {1, 2}, -1}, {0, {3, 4}, -1}});
  EXPECT_EQ(found.row(30), Eigen::RowVector2d(1, 2));
  EXPECT_EQ(found.array().isFinite().count(), 2);
}

}  // namespace
}  // namespace daumier::testing
