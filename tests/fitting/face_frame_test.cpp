#include "fitting/face_frame.h"

#include "tests/fitting/labelled_face.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::fitting {
namespace {

void ExpectSameFrame(const render::Placement& a, const render::Placement& b, double relative) {
  EXPECT_NEAR(a.scale, b.scale, relative * b.scale);
  EXPECT_NEAR(a.turn_degrees, b.turn_degrees, 60 * relative);
  EXPECT_LT((a.shift - b.shift).norm(), 256 * relative);
}

TEST(FaceFrame, OfMovedPointsIsTheMove) {
  const LabelledFace face;
  const Eigen::MatrixX2d on_sheet = face.OnSheet(face.gaussian.mean);
  for (const auto& frame :
       {render::Placement{}, render::Placement{0.5, {30, 80}, 12}, render::Placement{1.7, {-20, 5}, -9}}) {
    const auto found = FindFaceFrame(face.points, on_sheet, face.PointsOf(face.gaussian.mean, frame));
    ASSERT_TRUE(found.has_value());
    ExpectSameFrame(*found, frame, 0.02);
  }
}

TEST(FaceFrame, IgnoresAPointThatIsFarOff) {
  const LabelledFace face;
  const Eigen::MatrixX2d on_sheet = face.OnSheet(face.gaussian.mean);
  LabelledDrawing drawing = face.PointsOf(face.gaussian.mean);
  drawing.point(faces::FacePoint::kChin).position += Eigen::Vector2d(60, 70);
  drawing.point(faces::FacePoint::kBrowLeftInner).position -= Eigen::Vector2d(50, -10);
  ExpectSameFrame(*FindFaceFrame(face.points, on_sheet, drawing), {}, 0.01);
}

TEST(FaceFrame, OfOnePointIsTheUsualOneMovedThere) {
  const LabelledFace face;
  const Eigen::MatrixX2d on_sheet = face.OnSheet(face.gaussian.mean);
  for (const auto point : {faces::FacePoint::kNoseBottom, faces::FacePoint::kContourLeft}) {
    LabelledDrawing drawing;
    drawing.point(point) = {{70, 90}, 0.3};
    const auto frame = FindFaceFrame(face.points, on_sheet, drawing);
    ASSERT_TRUE(frame.has_value());
    EXPECT_NEAR(frame->scale, 1, 1e-3);
    EXPECT_NEAR(frame->turn_degrees, 0, 0.1);
    EXPECT_LT((faces::ProjectedFacePoint(face.points, point, on_sheet, render::ToSheet(*frame, {70, 90})) -
               render::ToSheet(*frame, {70, 90}))
                  .norm(),
              0.5);
  }
}

TEST(FaceFrame, IsAbsentWithoutPointsAndRefusesNumbersThatAreNone) {
  const LabelledFace face;
  const Eigen::MatrixX2d on_sheet = face.OnSheet(face.gaussian.mean);
  EXPECT_FALSE(FindFaceFrame(face.points, on_sheet, {}).has_value());
  LabelledDrawing drawing;
  drawing.point(faces::FacePoint::kChin) = {{std::nan(""), 1}, 1};
  testing::ExpectError([&] { FindFaceFrame(face.points, on_sheet, drawing); }, "the point chin");
}

}  // namespace
}  // namespace daumier::fitting
