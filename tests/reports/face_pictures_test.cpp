#include "reports/face_pictures.h"

#include "tests/support/synthetic_database.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::reports {
namespace {

TEST(FacePictures, OneFrameHoldsAllFacesAndViewsDiffer) {
  const testing::TempDir folder;
  testing::BuildSyntheticFaces(folder / "faces", 2);
  const faces::FaceDatabase database(folder / "faces");
  const std::vector<int> indices = {0, 3, database.num_faces() - 1};
  const render::Frame frame = FrameOfFaces(database, indices);
  for (const int face : indices) {
    const auto distance = (database.points(face).rowwise() - frame.centre.transpose()).cwiseAbs().maxCoeff();
    EXPECT_LE(distance, frame.half_height);
  }
  const render::Image front = FrontView(database, 0, frame), side = SideView(database, 0, frame);
  EXPECT_EQ(front.width, kCell);
  EXPECT_EQ(side.height, kCell);
  EXPECT_NE(front.pixels, side.pixels);
}

}  // namespace
}  // namespace daumier::reports
