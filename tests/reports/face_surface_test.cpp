#include "reports/face_surface.h"

#include "tests/support/expect_error.h"
#include "tests/support/synthetic_face.h"

#include <gtest/gtest.h>

namespace daumier::reports {
namespace {

TEST(FaceSurface, HasTheFacesVerticesAndColoursForAllThatClosesIt) {
  const faces::FaceTemplate face = testing::SyntheticFace();
  const render::RenderInput input = SurfaceOf(face, 2 * face.neutral);
  EXPECT_EQ(input.surface.vertices, 2 * face.neutral);
  EXPECT_EQ(input.surface.triangles, face.triangles);
  EXPECT_EQ(input.closing_triangles, face.closing_triangles);
  const auto expected = render::ClosingColours(int(face.closing_triangles.rows()), face.num_eye_closing_triangles);
  EXPECT_EQ(input.closing_colours, expected);
  const render::RenderInput of_surface = InputOf(SurfaceOf(face), 2 * face.neutral);
  EXPECT_EQ(of_surface.surface.triangles, input.surface.triangles);
  EXPECT_EQ(of_surface.closing_colours, input.closing_colours);
}

TEST(FaceSurface, RefusesAFaceOfAnotherTopology) {
  const faces::FaceTemplate face = testing::SyntheticFace();
  testing::ExpectError([&] { SurfaceOf(face, face.neutral.topRows(5)); }, "the face has 5 vertices");
}

}  // namespace
}  // namespace daumier::reports
