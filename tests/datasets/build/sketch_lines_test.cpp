#include "datasets/build/sketch_lines.h"

#include "datasets/build/sketch_views.h"
#include "faces/wrinkle_region.h"
#include "geometry/nearest.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_face.h"

#include <gtest/gtest.h>

#include <cmath>

namespace daumier::datasets {
namespace {

using faces::View;

/// The neutral synthetic face with a sharp dent of 1 cm across its wrinkle region.
geometry::Points Dented(const faces::FaceTemplate& face) {
  geometry::Points points = face.neutral;
  const auto region = faces::WrinkleRegion(face, View::kFrontal, 3);
  const Eigen::RowVector3d middle = points.row(region[region.size() / 2]);
  for (Eigen::Index v = 0; v < points.rows(); ++v) {
    const double distance = (points.row(v) - middle).norm();
    points(v, 2) -= 1.0 * std::exp(-distance * distance / 2);
  }
  return points;
}

TEST(SketchLines, CurvesComeFirstAndWrinklesBehindThem) {
  const faces::FaceTemplate face = testing::SyntheticFace();
  const SketchLines lines(face, View::kFrontal, {.contours = {.low = 0, .high = 0, .min_angle = 5, .min_length = 2}});
  const auto strokes = lines.Draw(Dented(face), SketchCamera(face, View::kFrontal, 0.62));
  const size_t num_curves = lines.curves().size();
  ASSERT_GT(strokes.size(), num_curves) << "the dent is seen";
  size_t num_points = 0;
  for (size_t s = 0; s < strokes.size(); ++s) {
    EXPECT_EQ(SketchKinds()[size_t(strokes[s].kind)] == "wrinkle", s >= num_curves);
    if (s < num_curves) num_points += strokes[s].points.size();
  }
  EXPECT_EQ(int(num_points), lines.num_curve_points());
}

TEST(SketchLines, WithoutWrinklesOnlyTheCurvesAreLeftUnchanged) {
  const faces::FaceTemplate face = testing::SyntheticFace();
  const auto camera = SketchCamera(face, View::kFrontal, 0.62);
  const WrinkleOptions eager{.contours = {.low = 0, .high = 0, .min_angle = 5, .min_length = 2}};
  const auto with = SketchLines(face, View::kFrontal, eager).Draw(Dented(face), camera);
  const auto without = SketchLines(face, View::kFrontal, {.drawn = false}).Draw(Dented(face), camera);
  ASSERT_LT(without.size(), with.size());
  for (size_t s = 0; s < without.size(); ++s) EXPECT_EQ(without[s].points, with[s].points);
}

TEST(SketchLines, WrinklesStayInTheirRegion) {
  const faces::FaceTemplate face = testing::SyntheticFace();
  const auto camera = SketchCamera(face, View::kFrontal, 0.62);
  const geometry::Points dented = Dented(face);
  const SketchLines lines(face, View::kFrontal, {.contours = {.low = 0, .high = 0, .min_angle = 5, .min_length = 2}});
  const auto strokes = lines.Draw(dented, camera);
  const auto region = faces::WrinkleRegion(face, View::kFrontal, 3);
  geometry::Points seen = render::Project(camera, dented)(region, Eigen::all);
  seen.col(2).setZero();
  const geometry::VertexTree tree(seen);
  for (size_t s = lines.curves().size(); s < strokes.size(); ++s) {
    for (const auto& [x, y] : strokes[s].points) EXPECT_LT(tree.Nearest({x, y, 0}).distance, 6) << "an edge's length";
  }
}

TEST(SketchLines, ASideViewHasTheSideCurves) {
  const faces::FaceTemplate face = testing::SyntheticFace();
  const SketchLines lines(face, View::kSide, {});
  const auto strokes = lines.Draw(face.neutral, SketchCamera(face, View::kSide, 0.62));
  ASSERT_GE(strokes.size(), 2u);
  EXPECT_EQ(SketchKinds()[size_t(strokes[0].kind)], "side_silhouette");
}

TEST(SketchLines, AnUnknownKindIsRefused) {
  faces::FaceTemplate face = testing::SyntheticFace();
  face.annotation.curves[0].kind = "moustache";
  testing::ExpectError([&] { SketchLines(face, View::kFrontal, {}); }, "unknown kind 'moustache'");
}

}  // namespace
}  // namespace daumier::datasets
