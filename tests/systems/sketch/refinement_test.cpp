#include "systems/sketch/refinement.h"

#include "geometry/flips.h"
#include "tests/support/expect_error.h"
#include "tests/support/from_threads.h"
#include "tests/support/refinement_subject.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>

namespace daumier::sketch {
namespace {

using geometry::Points;
using testing::ExpectError;
using testing::RefinementSubject;

constexpr View kFrontView{}, kRightView{-90, 0}, kTurnedView{40, 10};

const RefinementSubject& TheSubject() {
  static const RefinementSubject subject;
  return subject;
}
const Refinement& TheRefinement() {
  static const Refinement refinement(TheSubject().face_template);
  return refinement;
}

/// The mean face of the shipped weights.
class RefinementTest : public ::testing::Test {
 protected:
  RefinementState WithCheekRegion() const {
    return refinement_.Region(start_, front_, RefinementSubject::Loop(cheek_, 60, 75));
  }
  RefinementState WithCheekHandles() const { return refinement_.Brush(WithCheekRegion(), front_, {cheek_}, 30); }
  /// Mirrors displacements (V x 3).
  Points Mirrored(const Points& displacement) const {
    Points mirrored = displacement(subject_.face_template.annotation.mirror, Eigen::all);
    mirrored.col(0) *= -1;
    return mirrored;
  }
  double Millimetres() const { return faces::MillimetresPerCm(subject_.face_template); }

  const RefinementSubject& subject_ = TheSubject();
  const Refinement& refinement_ = TheRefinement();
  const render::Camera front_ = subject_.Camera(kFrontView), right_ = subject_.Camera(kRightView),
                       turned_ = subject_.Camera(kTurnedView);
  const RefinementState start_ = refinement_.Begin(subject_.face_template.neutral);
  const Eigen::Vector2d cheek_ = subject_.Cheek(kFrontView);
};

TEST_F(RefinementTest, OutsideOfTheRegionBytesStay) {
  const RefinementState state = WithCheekHandles();
  std::vector<bool> is_inside(size_t(start_.vertices.rows()));
  for (const int v : state.region->deformation.region()) is_inside[size_t(v)] = true;
  const CanvasPoints line = {cheek_, cheek_ + Eigen::Vector2d(6, -9)};
  const Points of_operations[] = {
      refinement_.Translate(state, front_, line).vertices, refinement_.Translate(state, turned_, line).vertices,
      refinement_.Roll(state, front_, 3).vertices, refinement_.Roll(state, right_, -2).vertices};
  for (const Points& moved : of_operations) {
    EXPECT_GT((moved - state.vertices).cwiseAbs().maxCoeff(), 0.1);
    for (int v = 0; v < moved.rows(); ++v) {
      if (is_inside[size_t(v)]) continue;
      EXPECT_EQ(std::memcmp(moved.row(v).data(), state.vertices.row(v).data(), 3 * sizeof(double)), 0) << v;
    }
  }
}

TEST_F(RefinementTest, HandlesMoveExactlyInThePlaneOfTheView) {
  const RefinementState state = WithCheekHandles();
  ASSERT_GT(state.handles.size(), 20u);
  const Eigen::Vector2d move(7, -5);
  for (const render::Camera& camera : {front_, turned_}) {
    const RefinementState moved =
        refinement_.Translate(state, camera, {cheek_, cheek_ + Eigen::Vector2d(50, 50), cheek_ + move});
    const Points before = render::Project(camera, state.vertices), after = render::Project(camera, moved.vertices);
    EXPECT_LT((after - before).col(2).cwiseAbs().maxCoeff(), 1e-12) << "depth of all vertices";
    for (const int v : state.handles)
      EXPECT_LT(((after.row(v) - before.row(v)).head<2>().transpose() - move).norm(), 1e-9);
  }
  const RefinementState stayed =
      refinement_.Translate(state, front_, {cheek_, cheek_ + Eigen::Vector2d(40, 0), cheek_});
  EXPECT_EQ(stayed.vertices, state.vertices) << "the line ends where it began";
}

TEST_F(RefinementTest, RollsHaveThreeHeightsAndCancel) {
  for (const RefinementState& state : {WithCheekHandles(), refinement_.Brush(start_, front_, {cheek_}, 30)}) {
    for (const int level : {1, 2, 3}) {
      const RefinementState bulged = refinement_.Roll(state, turned_, level);
      const Points towards = render::Project(turned_, state.vertices) - render::Project(turned_, bulged.vertices);
      EXPECT_NEAR(Millimetres() * towards.col(2).maxCoeff(), std::exp2(level), 1e-6) << "2, 4 and 8 mm";
      EXPECT_LT(towards.leftCols<2>().cwiseAbs().maxCoeff(), 1e-9);
      EXPECT_LT((refinement_.Roll(bulged, turned_, -level).vertices - state.vertices).cwiseAbs().maxCoeff(), 1e-9);
    }
  }
}

TEST_F(RefinementTest, TheWholeMeshMovesNearHandlesOnly) {
  const Eigen::Vector2d nose = subject_.Landmark(30, kFrontView);
  const RefinementState state = refinement_.Brush(start_, front_, {nose}, 12);
  const Points moved =
      refinement_.Translate(state, front_, {nose, nose + Eigen::Vector2d(0, -10)}).vertices - state.vertices;
  const double move = moved.rowwise().norm().maxCoeff();
  for (const int v : RegionFor(subject_.face_template.annotation, "ears", "a test"))
    EXPECT_LT(moved.row(v).norm(), 0.01 * move);
  for (const int v : RegionFor(subject_.face_template.annotation, "neck_border", "a test"))
    EXPECT_EQ(moved.row(v), Eigen::RowVector3d::Zero());
}

TEST_F(RefinementTest, BrushAndEraserUndoEachOther) {
  const CanvasPoints path = {cheek_, cheek_ + Eigen::Vector2d(30, 40)};
  for (const RefinementState& state : {start_, WithCheekRegion()}) {
    const RefinementState brushed = refinement_.Brush(state, front_, path, 20);
    EXPECT_GT(brushed.handles.size(), 30u);
    EXPECT_TRUE(std::ranges::is_sorted(brushed.handles));
    EXPECT_EQ(refinement_.Brush(brushed, front_, path, 20).handles, brushed.handles);
    EXPECT_TRUE(refinement_.Erase(brushed, front_, path, 20).handles.empty());
    const RefinementState half = refinement_.Erase(brushed, front_, {path[0]}, 20);
    EXPECT_GT(half.handles.size(), 5u);
    EXPECT_LT(half.handles.size(), brushed.handles.size());
    EXPECT_EQ(refinement_.Erase(brushed, subject_.Camera({180, 0}), {{256, 200}}, 150).handles, brushed.handles)
        << "from behind";
    EXPECT_EQ(refinement_.Brush(brushed, front_, {{2, 2}}, 3).handles, brushed.handles) << "on nothing";
  }
}

TEST_F(RefinementTest, HandlesLieInsideOfTheRegion) {
  const RefinementState state = refinement_.Brush(WithCheekRegion(), front_, {cheek_}, 300);
  const std::vector<int>& region = state.region->deformation.region();
  EXPECT_LT(state.handles.size(), region.size());
  const Points& neutral = subject_.face_template.neutral;
  const geometry::Adjacency neighbours =
      geometry::VertexNeighbours(subject_.face_template.triangles, subject_.face_template.num_vertices());
  for (const int fixed : geometry::VerticesWithin(neighbours, region, 1)) {
    if (std::ranges::binary_search(region, fixed)) continue;
    for (const int v : state.handles)
      EXPECT_GT((neutral.row(v) - neutral.row(fixed)).norm() * Millimetres(), 200 * Refinement::kRegionMargin);
  }
  const RefinementState elsewhere =
      refinement_.Region(state, front_, RefinementSubject::Loop(subject_.Landmark(24, kFrontView), 75, 50));
  for (const int v : elsewhere.handles) EXPECT_TRUE(elsewhere.region->is_inner[size_t(v)]);
}

TEST_F(RefinementTest, TheProfileFollowsALineInASideView) {
  for (const View& view : {kRightView, View{90, 0}}) {
    const double forwards = view.yaw_degrees < 0 ? 1 : -1;  // The profile looks to the right in the right side view.
    const CanvasPoints line =
        RefinementSubject::Swollen(subject_.Profile(3, -1.5, view), Eigen::Vector2d(14 * forwards, -4));
    const render::Camera camera = subject_.Camera(view);
    const Points after = refinement_.PullSilhouette(start_, camera, line).vertices, moved = after - start_.vertices;
    EXPECT_LT(moved.col(0).cwiseAbs().maxCoeff(), 1e-12) << "depth";
    EXPECT_LT((Mirrored(moved) - moved).cwiseAbs().maxCoeff() * Millimetres(), 0.1) << "symmetric, mm";
    EXPECT_GT(moved.col(2).maxCoeff() * Millimetres(), 6);
    const SurfaceLine profile =
        DefinedSilhouette(subject_.face_template.annotation, faces::View::kSide, render::Project(camera, after));
    for (size_t i = 0; i < profile.points.size(); ++i) {
      const double y = start_.vertices(profile.vertices[i][0], 1);
      if (y > 3 || y < -1.5) continue;
      EXPECT_LT(datasets::DistanceTo(line, profile.points[i]) / camera.scale * Millimetres(), 0.01) << "mm";
    }
  }
}

TEST_F(RefinementTest, TheOutlineFollowsALine) {
  const CanvasPoints line = RefinementSubject::Swollen(subject_.Landmarks(5, 11, kFrontView), {0, 16});
  const Points after = refinement_.PullSilhouette(start_, front_, line).vertices;
  EXPECT_LT((after - start_.vertices).col(2).cwiseAbs().maxCoeff(), 1e-12) << "depth";
  const geometry::TriangleMesh mesh{after, subject_.face_template.triangles};
  const std::vector<SurfaceLine> outlines = VisibleSilhouettes(mesh, front_, VisibleSurface(mesh, front_));
  double sum = 0;
  for (const Eigen::Vector2d& point : line) {
    double nearest = 1e9;
    for (const SurfaceLine& outline : outlines)
      nearest = std::min(nearest, datasets::DistanceTo(outline.points, point));
    sum += nearest;
  }
  EXPECT_LT(sum / double(line.size()) / front_.scale * Millimetres(), 1.0) << "mean, mm";
}

TEST_F(RefinementTest, LeftAndRightAreAlike) {
  const Eigen::Vector2d middle = subject_.Landmark(30, kFrontView),
                        to_right(middle.x() - (cheek_.x() - middle.x()), cheek_.y());
  const RefinementState left = refinement_.Brush(start_, front_, {cheek_}, 30);
  const RefinementState right = refinement_.Brush(start_, front_, {to_right}, 30);
  EXPECT_EQ(left.handles.size(), right.handles.size());
  const Points of_left = refinement_.Roll(left, front_, 3).vertices - start_.vertices;
  const Points of_right = refinement_.Roll(right, front_, 3).vertices - start_.vertices;
  EXPECT_LT((Mirrored(of_left) - of_right).cwiseAbs().maxCoeff() * Millimetres(), 0.05);
}

TEST_F(RefinementTest, TwentyOperationsLeaveNoFlippedTriangle) {
  RefinementState state = start_;
  for (int step = 0; step < 20; ++step) {
    const int landmarks[] = {24, 46, 54, 30, 8};
    const Eigen::Vector2d place = subject_.Landmark(landmarks[step % 5], kFrontView);
    if (step % 5 == 0) state = refinement_.Region(state, front_, RefinementSubject::Loop(place, 80, 60));
    if (step % 5 == 1) state.region = start_.region;
    state.handles.clear();
    state = refinement_.Brush(state, front_, {place}, 20);
    if (state.handles.empty()) continue;
    const Eigen::Vector2d move(step % 2 == 0 ? 5 : -4, step % 3 == 0 ? -5 : 3);
    state = step % 4 == 3 ? refinement_.Roll(state, turned_, step % 8 == 3 ? 2 : -2)
                          : refinement_.Translate(state, step % 2 == 0 ? front_ : turned_, {place, place + move});
  }
  EXPECT_GT((state.vertices - start_.vertices).rowwise().norm().maxCoeff() * Millimetres(), 5);
  EXPECT_LE(geometry::CountFlippedTriangles(start_.vertices, state.vertices, subject_.face_template.triangles), 0);
}

TEST_F(RefinementTest, MayBeUsedFromSeveralThreads) {
  testing::ExpectTheSameFromThreads(1, [&] {
    const RefinementState state = WithCheekHandles();
    const RefinementState moved = refinement_.Translate(state, front_, {cheek_, cheek_ + Eigen::Vector2d(5, 5)});
    return refinement_.Roll(moved, turned_, 1).vertices;
  });
}

TEST_F(RefinementTest, RefusesWhatItCannotDo) {
  ExpectError([&] { refinement_.Begin(Points::Zero(3, 3)); }, "a face of 3 vertices, expected 10350");
  ExpectError([&] { refinement_.Begin(Points::Constant(start_.vertices.rows(), 3, NAN)); }, "not finite");
  const CanvasPoints line = {cheek_, cheek_ + Eigen::Vector2d(9, 0)};
  ExpectError([&] { refinement_.Translate(start_, front_, line); }, "there is no handle; mark some");
  ExpectError([&] { refinement_.Roll(start_, front_, 2); }, "there is no handle; mark some");
  const RefinementState state = refinement_.Brush(start_, front_, {cheek_}, 20);
  for (const int level : {0, 4, -4}) ExpectError([&] { refinement_.Roll(state, front_, level); }, "expected 1 to 3");
  ExpectError([&] { refinement_.Translate(state, front_, {cheek_}); }, "shorter than a pixel");
  ExpectError([&] { refinement_.Translate(state, front_, {cheek_, {NAN, 0}}); }, "not finite");
  ExpectError([&] { refinement_.Translate(state, render::WithPerspective(front_, 50), line); }, "in perspective");
  ExpectError([&] { refinement_.Roll(state, render::WithPerspective(front_, 50), 1); }, "in perspective");
  ExpectError([&] { refinement_.PullSilhouette(start_, front_, {{5, 5}, {9, 60}}); }, "no silhouette of the region");
  ExpectError([&] { refinement_.PullSilhouette(WithCheekRegion(), right_, subject_.Profile(3, -1.5, kRightView)); },
              "no silhouette of the region");
  ExpectError([&] { refinement_.PullSilhouette(start_, front_, {}); }, "shorter than a pixel");
}

}  // namespace
}  // namespace daumier::sketch
