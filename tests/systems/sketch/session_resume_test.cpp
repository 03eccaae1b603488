#include "systems/shipped_weights.h"
#include "systems/sketch/session_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <vector>

namespace daumier::sketch {
namespace {

std::shared_ptr<const SketchPredictor> ShippedPredictor() {
  static const std::shared_ptr<const SketchPredictor> predictor = OpenSessionPredictor("weights/sketch-ict", {});
  return predictor;
}

void ExpectEqualStates(const SketchState& first, const SketchState& second) {
  EXPECT_EQ(first.is_pending, false);
  EXPECT_EQ(first.vertices, second.vertices);
  EXPECT_EQ(first.frame, second.frame);
  EXPECT_EQ(first.warnings, second.warnings);
  ASSERT_EQ(first.strokes.size(), second.strokes.size());
  ASSERT_EQ(first.lines.curves.size(), second.lines.curves.size());
  for (size_t i = 0; i < first.lines.curves.size(); ++i)
    EXPECT_EQ(first.lines.curves[i].points, second.lines.curves[i].points);
}

/// The two end in equal states, and have equal states before.
void ExpectEqualHistories(const SessionScript& script) {
  SketchSession replayed(ShippedPredictor(), script.width, script.height);
  SketchSession resumed(ShippedPredictor(), script.width, script.height);
  Replay(script, replayed, [](const ReplayedEvent&) {});
  Resume(script, resumed);
  ExpectEqualStates(*resumed.state(), *replayed.state());
  while (replayed.Undo()) {
    ASSERT_TRUE(resumed.Undo());
    ExpectEqualStates(*resumed.state(), *replayed.state());
  }
  EXPECT_FALSE(resumed.Undo());
  while (replayed.Redo()) ASSERT_TRUE(resumed.Redo());
  ExpectEqualStates(*resumed.state(), *replayed.state());
}

TEST(OpenSessionPredictor, DoesNotSearchForTurnedDrawings) {
  EXPECT_FALSE(ShippedPredictor()->options().parsing.turn);
  EXPECT_TRUE(PredictOptions().parsing.turn);
}

TEST(SessionResume, EndsAsAReplayWithAnEqualHistory) {
  SessionScript script = ReadSession("docs/examples/sessions/front.json");
  ExpectEqualHistories(script);
}

TEST(SessionResume, MirroredStrokesUndoAndRefinementAreAsInAReplay) {
  SessionScript script = ReadSession("docs/examples/sessions/front.json");
  script.events.resize(6);
  using enum SessionEvent::What;
  const CanvasPoints stroke = {{150, 200}, {170, 195}, {198, 205}};
  script.events.push_back({.what = kDraw, .points = stroke, .pen = {.mirror = true}});
  script.events.push_back({.what = kUndo});
  script.events.push_back({.what = kRedo});
  script.events.push_back({.what = kErase, .points = {{160, 198}}});
  script.events.push_back({.what = kRefine});
  script.events.push_back({.what = kFollowUp});
  ExpectEqualHistories(script);
}

TEST(SessionResume, LinesOfTheMeanFaceFollowAsInAReplay) {
  SessionScript script{.width = 300, .height = 300, .begin = {}, .events = {}};
  using enum SessionEvent::What;
  script.events = {{.what = kFollowUp},
                   {.what = kErase, .points = {{150, 200}, {150, 220}}},
                   {.what = kDraw, .points = {{140, 150}, {160, 150}}}};
  ExpectEqualHistories(script);
}

TEST(SessionResume, FacesOfEarlierStatesAreMadeAgainAsTheyWere) {
  SessionScript script = ReadSession("docs/examples/sessions/front.json");
  using enum SessionEvent::What;
  script.events.resize(6);
  script.events.push_back({.what = kFollowUp});
  script.events.push_back({.what = kErase, .points = {{200, 250}, {200, 300}}});
  script.events.push_back({.what = kRefine});
  const RefinementOperation brush{
      .what = RefinementOperation::What::kBrush, .points = {{200, 200}}, .view = {}, .radius = 5};
  for (size_t i = 0; i < SketchSession::kKeptFaces; ++i)
    script.events.push_back({.what = kOperation, .operation = brush});
  SketchSession session(ShippedPredictor(), script.width, script.height);
  std::vector<geometry::Points> faces = {session.state()->vertices};
  Replay(script, session, [&](const ReplayedEvent& event) { faces.push_back(event.state->vertices); });
  ASSERT_GT(faces.size(), SketchSession::kKeptFaces + 8);
  for (size_t i = faces.size(); i-- > 0;) {
    EXPECT_EQ(session.state()->vertices, faces[i]) << "after event " << i;
    session.Undo();
  }
}

TEST(SessionResume, DropsWhatCannotBeUndoneAnyMore) {
  SketchSession session(ShippedPredictor(), 100, 100);
  const size_t steps = SketchSession::kMostUndo + 5;
  for (size_t i = 0; i < steps; ++i)
    session.Draw({{10, 10.0 + double(i) / 10}, {20, 20}}, {}, {}, FaceTime::kWhenNeeded);
  EXPECT_EQ(session.state()->strokes.size(), steps);
  size_t undone = 0;
  while (session.Undo()) ++undone;
  EXPECT_EQ(undone, SketchSession::kMostUndo);
  EXPECT_EQ(session.state()->strokes.size(), steps - SketchSession::kMostUndo);
  EXPECT_FALSE(session.can_undo());
  EXPECT_TRUE(session.can_redo());
}

}  // namespace
}  // namespace daumier::sketch
