#include "fitting/projected_curves.h"

#include "tests/fitting/projected_face.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::fitting {
namespace {

/// Vertices (1, 2, 3), (4, 5, 6), (0, -1, 7); an open curve of two of them and a closed one of all.
faces::FaceTemplate ByHand() {
  faces::FaceTemplate face_template;
  face_template.neutral.resize(3, 3);
  face_template.neutral << 1, 2, 3, 4, 5, 6, 0, -1, 7;
  face_template.annotation.curves = {{.name = "open", .kind = "brow", .vertices = {2, 0}},
                                     {.name = "ring", .kind = "lips", .closed = true, .vertices = {0, 1, 2}}};
  return face_template;
}
const std::vector<float> kFace = {1, 2, 3, 4, 5, 6, 0, -1, 7};

render::Camera TenPixelsACm() {
  render::Camera camera;
  camera.scale = 10;
  camera.principal_point = {100, 80};
  return camera;
}

TEST(ProjectedCurves, AreWorkedOutByHand) {
  const auto curves = SeeCurves(ByHand(), {"ring", "open"}, TenPixelsACm());
  EXPECT_EQ(curves.vertices, (std::vector<int>{0, 1, 2, 0, 2, 0}));
  EXPECT_EQ(curves.offsets, (CurveOffsets{0, 4, 6}));
  const std::vector<float> expected = {110, 60, 140, 30, 100, 90, 110, 60, 100, 90, 110, 60};
  EXPECT_EQ(Project(curves, kFace), expected);
  const auto strokes = CurveStrokes(curves.offsets, expected);
  ASSERT_EQ(strokes.size(), 2u);
  EXPECT_EQ(strokes[0].points.size(), 4u);
  EXPECT_EQ(strokes[1].points[0], (std::array<float, 2>{100, 90}));
}

TEST(ProjectedCurves, OfAModelAreThoseOfItsFaces) {
  ProjectedFace seen;
  seen.curves.camera = render::TurnedCamera({0.5, 1, -2}, 15, render::kSketchCanvas, 20, -10);
  const ProjectedModel projected = ProjectModel(seen.curves, seen.model);
  EXPECT_EQ(projected.model.identity_factors, seen.model.identity_factors);
  EXPECT_EQ(projected.model.expression_factors, seen.model.expression_factors);
  for (const int identity : {0, 3, 11}) {
    const Eigen::VectorXf points = faces::Reconstruct(projected.model, seen.model.identity_factors.row(identity),
                                                      seen.model.expression_factors.row(identity % 9)) +
                                   projected.constant;
    const auto expected = seen.Points(seen.Face(identity, identity % 9));
    ASSERT_EQ(size_t(points.size()), expected.size());
    for (size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(points[Eigen::Index(i)], expected[i], 1e-3);
  }
}

TEST(ProjectedCurves, RefuseWhatDoesNotFit) {
  const auto curves = SeeCurves(ByHand(), {"ring"}, TenPixelsACm());
  testing::ExpectError([] { SeeCurves(ByHand(), {"nose"}, TenPixelsACm()); }, "no curve 'nose'");
  testing::ExpectError([&] { Project(curves, std::vector<float>(8)); }, "8 coordinates has no vertex 2");
  testing::ExpectError([&] { CurveStrokes(curves.offsets, std::vector<float>(6)); }, "6 coordinates for curves of 4");
  ProjectedFace seen;
  seen.curves.camera = render::WithPerspective(seen.curves.camera, 50);
  testing::ExpectError([&] { ProjectModel(seen.curves, seen.model); }, "orthographic");
}

}  // namespace
}  // namespace daumier::fitting
