#include "reports/face_pictures.h"

#include "tests/support/synthetic_face.h"

#include <gtest/gtest.h>

namespace daumier::reports {
namespace {

TEST(FacePictures, OneFrameHoldsAllFacesAndViewsDiffer) {
  const faces::FaceTemplate face = testing::SyntheticFace();
  const std::vector<geometry::Points> faces = {face.neutral, 1.2 * face.neutral};
  const render::Frame frame = FrameOfFaces(faces);
  for (const geometry::Points& points : faces) {
    const auto distance = (points.rowwise() - frame.centre.transpose()).cwiseAbs().maxCoeff();
    EXPECT_LE(distance, frame.half_height);
  }
  const faces::FinishedHead head(face);
  const render::Image front = FrontView(head, faces[0], frame), side = SideView(head, faces[0], frame);
  EXPECT_EQ(front.width, kCell);
  EXPECT_EQ(side.height, kCell);
  EXPECT_NE(front.pixels, side.pixels);
}

}  // namespace
}  // namespace daumier::reports
