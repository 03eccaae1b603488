#include "systems/sketch/sketch_session.h"

#include "systems/sketch/session_file.h"
#include "tests/fitting/drawn_circles.h"
#include "tests/support/expect_error.h"
#include "tests/support/ideal_parser_network.h"
#include "tests/support/plain_sketch_run.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stop_token>
#include <thread>

namespace daumier::sketch {
namespace {

using testing::ExpectError;

CanvasPoints PointsOf(const render::Stroke& stroke) {
  CanvasPoints points;
  for (const auto& [x, y] : stroke.points) points.emplace_back(x, y);
  return points;
}

class SketchSessionTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<testing::TempDir>();
    testing::WritePlainSketchRun(folder_->path());
  }
  static void TearDownTestSuite() { folder_.reset(); }

  SketchSessionTest() {
    const SketchRunFolder run = ReadSketchRunFolder(folder_->path());
    predictor_ = std::make_shared<const SketchPredictor>(
        run, std::make_shared<testing::FixedNetwork>(run.models.bilinear),
        std::make_shared<const DrawingParser>(ParserNetworkOptions(),
                                              std::make_shared<testing::IdealParserNetwork>(ParserNetworkOptions())));
  }
  SketchSession Open() const { return SketchSession(predictor_, 256, 256); }
  /// The largest distance of a curve's points from where the camera sees the face's vertices, in pixels of the canvas.
  double Disagreement(const SketchState& state) const {
    const fitting::ProjectedCurves& curves = predictor_->curves();
    const geometry::Points seen = render::Project(curves.camera, state.vertices);
    double largest = 0;
    size_t point = 0;
    for (const SessionCurve& curve : state.lines.curves)
      for (const Eigen::Vector2d& target : curve.points)
        largest = std::max(largest, (seen.row(curves.vertices[point++]).head<2>().transpose() - target).norm());
    return largest;
  }
  /// Erases the segment at the middle of a curve and draws it shifted; returns the curve's middle point.
  static size_t Redraw(SketchSession& session, size_t curve, const Eigen::Vector2d& shift, const Pen& pen = {}) {
    const render::Placement sheet = render::Inverse(session.state()->frame);
    const auto on_sheet = [&](const Eigen::Vector2d& p) { return render::ToCanvas(sheet, p); };
    const CanvasPoints before = session.state()->lines.curves[curve].points;
    const size_t middle = before.size() / 2;
    EXPECT_TRUE(session.Erase({on_sheet(before[middle])}));
    const CurveGap gap = *session.state()->lines.curves[curve].gap;
    CanvasPoints stroke;
    for (size_t i = std::max<size_t>(gap.first, 1) - 1; i <= std::min(gap.last + 1, before.size() - 1); ++i)
      stroke.push_back(on_sheet(before[i] + (i >= gap.first && i <= gap.last ? shift : Eigen::Vector2d(0, 0))));
    session.Draw(stroke, pen);
    return middle;
  }

  inline static std::unique_ptr<testing::TempDir> folder_;
  std::shared_ptr<const SketchPredictor> predictor_;
};

TEST_F(SketchSessionTest, InitialModePredictsAsThePredictorDoes) {
  SketchSession session = Open();
  EXPECT_EQ(session.state()->vertices.rows(), 0) << "a blank sheet has no face";
  for (const render::Stroke& circle : fitting::Circles()) session.Draw(PointsOf(circle));
  const systems::Input drawing = render::Drawing{256, 256, fitting::Circles()};
  EXPECT_EQ(session.state()->vertices, predictor_->Predict(std::span(&drawing, 1)).front().vertices);
  EXPECT_EQ(session.state()->strokes.size(), fitting::Circles().size());
  EXPECT_EQ(session.Preview({{10, 10}, {20, 20}}).rows(), session.state()->vertices.rows());
}

TEST_F(SketchSessionTest, TheEraserCutsStrokesOfInitialMode) {
  SketchSession session = Open();
  session.Draw({{20, 100}, {220, 100}});
  session.Draw({{20, 200}, {220, 200}});
  EXPECT_FALSE(session.Erase({{120, 150}}));
  EXPECT_TRUE(session.Erase({{120, 90}, {120, 110}}));
  const std::vector<render::WeightedStroke>& strokes = session.state()->strokes;
  ASSERT_EQ(strokes.size(), 3u);
  EXPECT_LE(strokes[0].points.back()[0], 115);
  EXPECT_GE(strokes[1].points.front()[0], 125);
  EXPECT_EQ(strokes[2].points.size(), 2u) << "what it does not reach is unchanged";
}

TEST_F(SketchSessionTest, AMirrorDrawsAndErasesOnBothSides) {
  SketchSession session = Open();
  session.Draw({{20, 100}, {60, 120}}, {.mirror = true});
  ASSERT_EQ(session.state()->strokes.size(), 2u);
  EXPECT_EQ(PointsOf(session.state()->strokes[1]), (CanvasPoints{{236, 100}, {196, 120}}))
      << "about the sheet's middle";
  EXPECT_TRUE(session.Erase({{20, 100}, {60, 120}}, /*mirror=*/true));
  EXPECT_TRUE(session.state()->strokes.empty());
  EXPECT_TRUE(session.Undo());
  EXPECT_TRUE(session.Undo());
  EXPECT_TRUE(session.state()->strokes.empty()) << "both lines are one event";
}

TEST_F(SketchSessionTest, AMirrorRedrawsBothSidesOfTheFace) {
  SketchSession session = Open();
  session.FollowUp();
  const geometry::Points seen = render::Project(predictor_->curves().camera, geometry::Points::Zero(1, 3));
  const CanvasPoints wrinkle = {{60, 60}, {70, 60}};
  session.Draw(wrinkle, {.mirror = true});
  ASSERT_EQ(session.state()->lines.wrinkles.size(), 2u);
  EXPECT_NEAR(session.state()->lines.wrinkles[1].points[0].x(), 2 * seen(0, 0) - 60, 1e-9) << "about the face's middle";
}

TEST_F(SketchSessionTest, AStabiliserSmoothsTheStroke) {
  SketchSession session = Open();
  CanvasPoints shaken;
  for (int i = 0; i < 60; ++i) shaken.emplace_back(20 + 3 * i, 100 + (i % 2 == 0 ? 3 : -3));
  session.Draw(shaken, {.stabiliser = 25});
  const CanvasPoints drawn = PointsOf(session.state()->strokes.front());
  for (size_t i = 1; i + 1 < drawn.size(); ++i) EXPECT_LT(std::abs(drawn[i].y() - drawn[i - 1].y()), 1);
}

TEST_F(SketchSessionTest, TheWeightOfAPenIsKeptAndChangesNoFace) {
  SketchSession session = Open(), plain = Open();
  for (const render::Stroke& circle : fitting::Circles()) {
    session.Draw(PointsOf(circle), {.weight = 4});
    plain.Draw(PointsOf(circle));
  }
  EXPECT_EQ(session.state()->vertices, plain.state()->vertices);
  EXPECT_EQ(session.state()->strokes.front().widths.front(), 4);
  session.Erase({PointsOf(session.state()->strokes.front()).front()});
  for (const render::WeightedStroke& stroke : session.state()->strokes)
    EXPECT_EQ(stroke.widths, std::vector<float>(stroke.points.size(), 4));
  session.FollowUp();
  const double scale = session.state()->frame.scale;
  const size_t middle = Redraw(session, 0, {2, -3}, {.weight = 5});
  EXPECT_NEAR(session.state()->lines.curves[0].widths[middle], 5 * scale, 1e-9);
  session.Refine();
  EXPECT_NEAR(session.state()->lines.curves[0].widths[middle], 5 * scale, 1e-9);
  session.FollowUp();
  EXPECT_NEAR(session.state()->lines.curves[0].widths[middle], 5 * scale, 1e-9);
  const auto on_sheet = SketchSession::OnSheet(*session.state());
  EXPECT_NEAR(on_sheet.front().widths[middle], 5, 1e-5);
  ExpectError([&] { session.Draw({{1, 1}, {9, 9}}, {.weight = 26}); }, "26 pixels wide on a sheet of 256 x 256");
}

/// Always of the same scores.
class FixedScores : public runtime::NetworkRunner {
 public:
  explicit FixedScores(datasets::Gesture gesture) : gesture_(gesture) {}
  NamedArrays Run(const NamedArrays& inputs) const override {
    (void)inputs;
    FloatArray scores({1, kNumGestureClasses});
    scores.values.assign(scores.values.size(), 0.0f);
    scores.values[size_t(gesture_)] = 20;
    return {{"scores", scores}};
  }

 private:
  datasets::Gesture gesture_;
};

TEST_F(SketchSessionTest, RefinementMovesTheFaceItBeganWith) {
  SketchSession session = Open();
  using What = RefinementOperation::What;
  ExpectError([&] { session.Apply({.what = What::kRoll, .level = 1}); }, "refinement has not begun");
  session.Refine();
  const SketchState before = *session.state();
  ASSERT_TRUE(before.is_refinement());
  EXPECT_EQ(before.vertices, predictor_->run().face_template.neutral);
  const render::Camera camera = session.CameraOf(before, {});
  const geometry::Points seen = render::Project(camera, before.vertices);
  const Eigen::Vector2d middle =
      (seen.leftCols<2>().colwise().minCoeff() + seen.leftCols<2>().colwise().maxCoeff()) / 2;
  session.Apply({.what = What::kBrush, .points = {middle}, .radius = 20});
  ASSERT_FALSE(session.state()->refinement->handles.empty());
  session.Apply({.what = What::kTranslate, .points = {middle, middle + Eigen::Vector2d(4, 0)}});
  const SketchState& after = *session.state();
  const Eigen::Index handle = after.refinement->handles.front();
  const geometry::Points moved = render::Project(camera, after.vertices);
  EXPECT_NEAR(moved(handle, 0) - seen(handle, 0), 4, 1e-6) << "as far as the line is long";
  EXPECT_NEAR(moved(handle, 2), seen(handle, 2), 1e-9) << "in the plane of the view";
  EXPECT_LT(Disagreement(after), 1e-3) << "lines are those of the face";
  ExpectError([&] { session.Draw({{5, 5}, {9, 9}}); }, "begin follow-up mode first");
  ExpectError([&] { session.Erase({{5, 5}}); }, "begin follow-up mode first");
  session.FollowUp();
  EXPECT_EQ(session.state()->vertices, after.vertices);
  EXPECT_TRUE(session.Undo());
  EXPECT_TRUE(session.Undo());
  EXPECT_EQ(session.state()->vertices, before.vertices);
}

TEST_F(SketchSessionTest, AGestureDoesWhatItMeans) {
  using enum datasets::Gesture;
  const GestureDecision decision{.rejection = {.threshold = 0.5}};
  const auto session_with = [&](datasets::Gesture gesture) {
    return SketchSession(predictor_, 256, 256,
                         std::make_shared<const GestureRecogniser>(decision, std::make_shared<FixedScores>(gesture)));
  };
  const CanvasPoints stroke = {{100, 100}, {150, 110}};
  SketchSession left = session_with(kLeftArrow);
  ExpectError([&] { left.DoGesture(stroke, {}); }, "refinement has not begun");
  left.Refine();
  const auto refined = left.state();
  EXPECT_EQ(left.DoGesture(stroke, {}), kLeftArrow);
  EXPECT_FALSE(left.state()->is_refinement()) << "undone";
  SketchSession none = session_with(kNone);
  none.Refine();
  EXPECT_EQ(none.DoGesture(stroke, {}), kNone);
  EXPECT_EQ(none.state()->vertices, refined->vertices);
  SketchSession roll = session_with(kUpRoll2);
  roll.Refine();
  ExpectError([&] { roll.DoGesture(stroke, {}); }, "handle");
  SketchSession without = Open();
  without.Refine();
  ExpectError([&] { without.DoGesture(stroke, {}); }, "there is no network of gestures");
}

TEST_F(SketchSessionTest, AReplayReportsWhatStrokesWereRecognisedAs) {
  SketchSession session(predictor_, 256, 256,
                        std::make_shared<const GestureRecogniser>(
                            GestureDecision(), std::make_shared<FixedScores>(datasets::Gesture::kLeftArrow)));
  const SessionScript script{
      256,
      256,
      "",
      {{.what = SessionEvent::What::kRefine}, {.what = SessionEvent::What::kGesture, .points = {{1, 1}, {40, 3}}}}};
  std::vector<std::optional<datasets::Gesture>> gestures;
  Replay(script, session, [&](const ReplayedEvent& event) { gestures.push_back(event.gesture); });
  EXPECT_EQ(gestures, (std::vector<std::optional<datasets::Gesture>>{std::nullopt, datasets::Gesture::kLeftArrow}));
}

TEST_F(SketchSessionTest, FollowUpBeginsWithTheFaceItself) {
  SketchSession session = Open();
  for (const render::Stroke& circle : fitting::Circles()) session.Draw(PointsOf(circle));
  const geometry::Points face = session.state()->vertices;
  session.FollowUp();
  EXPECT_TRUE(session.state()->is_follow_up());
  EXPECT_EQ(session.state()->vertices, face);
  EXPECT_LT(Disagreement(*session.state()), 1e-3);
  session.Draw({{5, 5}, {9, 9}});  // A wrinkle: this network does not see it.
  EXPECT_LT((session.state()->vertices - face).cwiseAbs().maxCoeff(), 1e-5);
}

TEST_F(SketchSessionTest, RedrawnCurvesAreWhereTheyWereDrawn) {
  SketchSession session = Open();
  session.FollowUp();
  const SketchState before = *session.state();
  const size_t middle = Redraw(session, 0, {2, -3});
  const SketchState& after = *session.state();
  EXPECT_GT((after.lines.curves[0].points[middle] - before.lines.curves[0].points[middle]).norm(), 1);
  EXPECT_LT(Disagreement(after), 1e-6);
}

TEST_F(SketchSessionTest, UndoAndRedoGiveTheSameStates) {
  SketchSession session = Open();
  EXPECT_FALSE(session.Undo());
  session.FollowUp();
  const auto first = session.state();
  Redraw(session, 0, {2, 2});
  const auto last = session.state();
  EXPECT_TRUE(session.Undo());  // The stroke.
  EXPECT_TRUE(session.Undo());  // The erasing.
  EXPECT_EQ(session.state(), first);
  EXPECT_TRUE(session.Redo());
  EXPECT_TRUE(session.Redo());
  EXPECT_FALSE(session.Redo());
  EXPECT_EQ(session.state(), last);
  session.Undo();
  session.Draw({{5, 5}, {9, 9}});
  EXPECT_FALSE(session.Redo()) << "another future begins";
}

TEST_F(SketchSessionTest, TheLastStepsAloneCanBeUndone) {
  SketchSession session = Open();
  constexpr size_t kBefore = 3;
  const geometry::Points face = predictor_->run().face_template.neutral;
  std::vector<std::shared_ptr<const SketchState>> states = {session.state()};
  for (size_t i = 0; i < SketchSession::kMostUndo + kBefore; ++i) {
    session.FollowUpFrom(face);  // Each is a step.
    states.push_back(session.state());
  }
  for (size_t i = 0; i < SketchSession::kMostUndo; ++i) ASSERT_TRUE(session.Undo()) << i;
  EXPECT_FALSE(session.can_undo());
  EXPECT_FALSE(session.Undo());
  EXPECT_EQ(session.state(), states[kBefore]) << "earlier states are dropped";
  for (size_t i = 0; i < SketchSession::kMostUndo; ++i) ASSERT_TRUE(session.Redo()) << i;
  EXPECT_FALSE(session.can_redo());
  EXPECT_EQ(session.state(), states.back());
}

TEST_F(SketchSessionTest, AFailedCallChangesNothing) {
  SketchSession session = Open();
  const auto before = session.state();
  ExpectError([&] { session.Draw({{1, 1}}); }, "shorter than a pixel");
  ExpectError([&] { session.Erase({}); }, "has no point");
  ExpectError([&] { session.FollowUpFrom(geometry::Points::Zero(3, 3)); }, "a face of 3 vertices, expected");
  session.FollowUp();
  std::stop_source stop;
  stop.request_stop();
  EXPECT_THROW(session.Draw({{5, 5}, {9, 9}}, {}, Task(stop.get_token())), Cancelled);
  EXPECT_TRUE(session.Undo());
  EXPECT_EQ(session.state(), before);
  ExpectError([&] { SketchSession(predictor_, 0, 10); }, "expected sizes from 1 to");
  ExpectError([&] { session.Draw({{1, 1}, {1e9, 1}}); }, "lies far outside the sheet");
  ExpectError([&] { session.Erase({{1, -1e300}}); }, "lies far outside the sheet");
}

TEST_F(SketchSessionTest, AReplayGivesTheStatesOfTheCalls) {
  SketchSession session = Open(), replayed = Open();
  SessionScript script{256, 256, "", {{SessionEvent::What::kFollowUp, {}}, {SessionEvent::What::kErase, {{5, 250}}}}};
  session.FollowUp();
  script.events.push_back({.what = SessionEvent::What::kDraw, .points = {{5, 5}, {9, 9}}});
  session.Draw({{5, 5}, {9, 9}});
  script.events.push_back({SessionEvent::What::kUndo, {}});
  std::vector<size_t> wrinkles;
  Replay(script, replayed, [&](const ReplayedEvent& event) {
    EXPECT_EQ(event.number, wrinkles.size() + 1);
    EXPECT_FALSE(event.gesture.has_value());
    wrinkles.push_back(event.state->lines.wrinkles.size());
    if (event.number == 3) {
      EXPECT_EQ(event.state->vertices, session.state()->vertices);
    }
  });
  EXPECT_EQ(wrinkles, (std::vector<size_t>{0, 0, 1, 0})) << "nothing lies under the eraser";
  script.events[2].points = {{1, 1}};
  ExpectError([&] { Replay(script, session, [](const ReplayedEvent&) {}); }, "event 3 (draw): a stroke is shorter");
}

TEST_F(SketchSessionTest, StatesAreReadWhileAnotherThreadDraws) {
  SketchSession session = Open();
  session.FollowUp();
  std::atomic<bool> is_done = false;
  std::atomic<int> num_read = 0;
  std::jthread reader([&] {
    while (!is_done) num_read += session.state()->vertices.allFinite() ? 1 : 0;
  });
  while (num_read == 0) std::this_thread::yield();
  for (int i = 0; i < 5; ++i) session.Draw({{5.0 + i, 5}, {9.0 + i, 9}});
  is_done = true;
  reader.join();
  EXPECT_EQ(session.state()->lines.wrinkles.size(), 5u);
}

}  // namespace
}  // namespace daumier::sketch
