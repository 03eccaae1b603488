#include "reports/face_surface.h"

#include "tests/support/expect_error.h"
#include "tests/support/synthetic_face.h"

#include <gtest/gtest.h>

namespace daumier::reports {
namespace {

TEST(FaceSurface, DrawsTheFinishedHead) {
  const faces::FaceTemplate face = testing::SyntheticFace();
  const faces::FinishedHead head(face);
  const render::RenderInput input = InputOf(head, 2 * face.neutral);
  EXPECT_EQ(input.surface.vertices, head.Vertices(2 * face.neutral));
  EXPECT_EQ(input.surface.triangles, head.skin());
  EXPECT_EQ(input.closing_triangles, head.parts());
  EXPECT_TRUE(input.is_solid);
  ASSERT_EQ(input.closing_colours.size(), size_t(head.parts().rows()));
  ASSERT_EQ(input.closing_gloss.size(), size_t(head.parts().rows()));
  for (size_t i = 0; i < input.closing_colours.size(); ++i)
    EXPECT_EQ(input.closing_colours[i], LookOf(head.part_materials()[i]).colour);
}

TEST(FaceSurface, OfAReportIsThatOfItsTemplate) {
  const faces::FaceTemplate face = testing::SyntheticFace();
  const faces::FinishedHead head = HeadOf(SurfaceOf(face), face.neutral);
  EXPECT_EQ(head.skin(), faces::FinishedHead(face).skin());
  EXPECT_EQ(head.Vertices(face.neutral), faces::FinishedHead(face).Vertices(face.neutral));
  testing::ExpectError([&] { InputOf(head, face.neutral.topRows(5)); }, "the face has 5 vertices");
}

TEST(MaterialLook, EyesAreLightWithADarkPupilAndWet) {
  const auto brightness = [](faces::HeadMaterial material) {
    const render::Rgb colour = LookOf(material).colour;
    return colour[0] + colour[1] + colour[2];
  };
  using enum faces::HeadMaterial;
  EXPECT_GT(brightness(kSclera), 3 * 220);
  EXPECT_LT(brightness(kPupil), brightness(kLimbus));
  EXPECT_LT(brightness(kLimbus), brightness(kIris));
  EXPECT_LT(brightness(kThroat), brightness(kMouth));
  EXPECT_LT(brightness(kMouth), brightness(kInnerLip));
  EXPECT_EQ(LookOf(kSkin).colour, render::ShadingStyle().clay);
  EXPECT_GT(LookOf(kIris).gloss, 0);
  EXPECT_EQ(LookOf(kMouth).gloss, 0);
}

}  // namespace
}  // namespace daumier::reports
