#include "datasets/styles/sheet_layout.h"

#include "tests/support/plain_face_shape.h"

#include <cmath>

namespace daumier::datasets {
namespace {

LineSheet FaceAndShoulders() {
  LineSheet sheet;
  const FaceShape shape = testing::PlainFaceShape();
  sheet.Add(DrawnPart::kOutline, faces::LineLabel::kSilhouette, shape.head());
  sheet.Add(DrawnPart::kBust, faces::LineLabel::kNeck, {{10, 260}, {128, 220}, {246, 260}});
  return sheet;
}

Eigen::AlignedBox2d BoxOnCanvas(const LineSheet& sheet, size_t line, const render::Placement& pose) {
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector2d& point : sheet.lines[line].points) box.extend(render::ToCanvas(pose, point));
  return box;
}

TEST(SheetLayout, TheFaceStaysOnTheCanvas) {
  const LineSheet sheet = FaceAndShoulders();
  const PageStyles page = {.cropped = 0.5, .off_centre = 0.5};
  int num_cropped = 0, num_small = 0;
  for (uint64_t seed = 0; seed < 200; ++seed) {
    Rng rng(seed);
    const render::Placement pose = DrawSheetPose(sheet, page, rng);
    EXPECT_LE(std::abs(pose.turn_degrees), page.greatest_turn);
    const Eigen::AlignedBox2d face = BoxOnCanvas(sheet, 0, pose), bust = BoxOnCanvas(sheet, 1, pose);
    EXPECT_GE(face.min().minCoeff(), 2 - 1e-6) << seed;
    EXPECT_LE(face.max().maxCoeff(), 254 + 1e-6) << seed;
    num_cropped += bust.max().maxCoeff() > 256 ? 1 : 0;
    num_small += face.merged(bust).sizes().maxCoeff() < 190 ? 1 : 0;
  }
  EXPECT_GT(num_cropped, 30);
  EXPECT_GT(num_small, 10);
}

TEST(SheetLayout, AWholeDrawingFillsTheCanvasToItsMargin) {
  const LineSheet sheet = FaceAndShoulders();
  const PageStyles page = {.turn_degrees = 0, .small = 0, .cropped = 0, .off_centre = 0};
  for (uint64_t seed = 0; seed < 50; ++seed) {
    Rng rng(seed);
    const render::Placement pose = DrawSheetPose(sheet, page, rng);
    EXPECT_EQ(pose.turn_degrees, 0);
    const Eigen::AlignedBox2d all = BoxOnCanvas(sheet, 0, pose).merged(BoxOnCanvas(sheet, 1, pose));
    EXPECT_GE(all.sizes().maxCoeff(), 256 - 2 * 24 - 1e-6);
    EXPECT_LE(all.sizes().maxCoeff(), 250 + 1e-6);
  }
}

}  // namespace
}  // namespace daumier::datasets
