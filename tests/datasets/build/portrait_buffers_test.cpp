#include "datasets/build/portrait_buffers.h"

#include "datasets/read/portrait_camera.h"

#include <gtest/gtest.h>

namespace daumier::datasets {
namespace {

const std::vector<float> kStraight(6, 0.0f);

/// Squares that face the viewer, `half` cm from the axis to their sides.
struct Square {
  double half, z, shift_x;
  PictureClass mask_class;
  PicturePart part;
};

faces::PortraitHead HeadOf(const std::vector<Square>& squares) {
  faces::PortraitHead head;
  const auto n = static_cast<Eigen::Index>(squares.size());
  head.vertices.resize(4 * n, 3);
  head.triangles.resize(2 * n, 3);
  head.colours.resize(4 * n, 3);
  for (Eigen::Index s = 0; s < n; ++s) {
    const Square& square = squares[size_t(s)];
    const double h = square.half, x = square.shift_x;
    head.vertices.middleRows(4 * s, 4) << x - h, -h, square.z, x + h, -h, square.z, x + h, h, square.z, x - h, h,
        square.z;
    head.triangles.middleRows(2 * s, 2) << 4 * s, 4 * s + 1, 4 * s + 2, 4 * s, 4 * s + 2, 4 * s + 3;
    head.colours.middleRows(4 * s, 4).setConstant(0.25f * float(s + 1));
    for (int t = 0; t < 2; ++t) {
      head.classes.push_back(static_cast<uint8_t>(square.mask_class));
      head.parts.push_back(static_cast<uint8_t>(square.part));
    }
  }
  return head;
}

TEST(PortraitBuffers, TheNearerSurfaceIsSeenWithItsColourNormalAndDepth) {
  const auto head =
      HeadOf({{8, 0, 0, PictureClass::kSkin, PicturePart::kSkin}, {2, 5, 0, PictureClass::kHair, PicturePart::kHair}});
  const SphericalLight light = ProjectLight(0.4, {{Eigen::Vector3d::UnitZ(), 0.5}});
  const auto buffers = DrawBuffers(head, PortraitCamera({}, kStraight), light, 2);
  ASSERT_EQ(buffers.height, 448);
  const size_t middle = size_t(224) * 448 + 224, skin = size_t(224) * 448 + 224 + 100, outside = 3;
  EXPECT_NEAR(buffers.depth[middle], 95, 1e-3);
  EXPECT_NEAR(buffers.depth[skin], 100, 1e-3);
  EXPECT_FALSE(buffers.is_covered(outside));
  EXPECT_NEAR(buffers.albedo[3 * middle], 0.5f, 1e-5);
  EXPECT_NEAR(buffers.albedo[3 * skin + 2], 0.25f, 1e-5);
  EXPECT_NEAR(buffers.normal[3 * middle + 2], 1, 1e-5);
  EXPECT_NEAR(buffers.shade[middle], LightOn(light, Eigen::Vector3f::UnitZ()), 1e-5);
  EXPECT_EQ(buffers.classes[middle], uint8_t(PictureClass::kHair));
  EXPECT_EQ(buffers.parts[skin], uint8_t(PicturePart::kSkin));
}

TEST(PortraitBuffers, ASurfaceOfTwoSidesIsLitFromTheSideThatIsSeen) {
  auto head = HeadOf({{8, 0, 0, PictureClass::kHair, PicturePart::kHair}});
  const SphericalLight light = ProjectLight(0.2, {{Eigen::Vector3d::UnitZ(), 0.7}});
  const render::Camera camera = PortraitCamera({}, kStraight);
  const float front = DrawBuffers(head, camera, light, 1).shade[112 * 224 + 112];
  head.triangles.col(1).swap(head.triangles.col(2));
  EXPECT_FLOAT_EQ(DrawBuffers(head, camera, light, 1).shade[112 * 224 + 112], front);
  std::fill(head.parts.begin(), head.parts.end(), uint8_t(PicturePart::kSkin));
  EXPECT_FALSE(DrawBuffers(head, camera, light, 1).is_covered(112 * 224 + 112)) << "skin has one side";
}

TEST(PortraitMask, HasTheClassOfMostSamples) {
  render::PictureBuffers buffers = render::EmptyPictureBuffers(2, 4, 2);
  buffers.classes = {1, 1, 0, 3,  //
                     1, 0, 3, 0};
  const render::Image mask = MaskOf(buffers);
  ASSERT_EQ(mask.width, 2);
  EXPECT_EQ(mask.at(0, 0), 1);
  EXPECT_EQ(mask.at(0, 1), 0) << "a tie";
}

TEST(SeenPoints, AnOccluderHidesWhatIsBehindIt) {
  const auto head = HeadOf({{8, 0, 0, PictureClass::kSkin, PicturePart::kSkin},
                            {2, 5, 0, PictureClass::kBackground, PicturePart::kGlasses}});
  const render::Camera camera = PortraitCamera({}, kStraight);
  const auto buffers = DrawBuffers(head, camera, {}, 2);
  geometry::Points points(5, 3);
  points << 0, 0, 0,  // Behind the small square.
      5, 0, 0,        // Next to it.
      0, 0, 5,        // On it.
      5, 0, -1,       // Inside of the head.
      40, 0, 0;       // Outside of the picture.
  EXPECT_EQ(SeenPoints(buffers, camera, points, 0.3), (std::vector<uint8_t>{0, 1, 1, 0, 0}));
}

}  // namespace
}  // namespace daumier::datasets
