// What a person waits for while drawing, with weights/sketch-ict and the strokes of docs/examples/sessions/front.json: while
// the pen is down, when it is lifted, and for an edit of a line. Side by side: the face of the network alone, and that of
// parser, network and fit.
#include "systems/sketch/session_file.h"
#include "tests/support/paths.h"

#include <benchmark/benchmark.h>

#include <memory>

namespace daumier::sketch {
namespace {

struct SessionCase {
  SessionScript script = ReadSession(testing::SourceRoot() / "docs/examples/sessions/front.json");
  std::shared_ptr<const SketchPredictor> predictor = std::dynamic_pointer_cast<const SketchPredictor>(
      std::shared_ptr<const systems::Predictor>(OpenSketchPredictor(testing::SourceRoot() / "weights/sketch-ict", {})));
  std::vector<CanvasPoints> strokes;

  SessionCase() {
    for (const SessionEvent& event : script.events) {
      if (event.what == SessionEvent::What::kFollowUp) break;
      strokes.push_back(event.points);
    }
  }
  /// A session with all strokes of the drawing but the last `left_out`.
  std::unique_ptr<SketchSession> Drawn(size_t left_out) const {
    auto session = std::make_unique<SketchSession>(predictor, script.width, script.height);
    for (size_t i = 0; i + left_out < strokes.size(); ++i) session->Draw(strokes[i]);
    return session;
  }
};

const SessionCase& TheCase() {
  static const SessionCase the_case;
  return the_case;
}

void PenDown(benchmark::State& state) {
  const SessionCase& c = TheCase();
  const auto session = c.Drawn(1);
  for (auto _ : state) benchmark::DoNotOptimize(session->Preview(c.strokes.back()));
}
BENCHMARK(PenDown)->Name("pen down: network alone")->Unit(benchmark::kMillisecond);

void PenUp(benchmark::State& state) {
  const SessionCase& c = TheCase();
  const auto session = c.Drawn(1);
  for (auto _ : state) {
    session->Draw(c.strokes.back());
    state.PauseTiming();
    session->Undo();
    state.ResumeTiming();
  }
}
BENCHMARK(PenUp)->Name("pen up: parser, network and fit")->Unit(benchmark::kMillisecond)->UseRealTime();

void FirstFactorisation(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(CurveFollower(TheCase().predictor));
}
BENCHMARK(FirstFactorisation)->Name("first factorisation")->Unit(benchmark::kMillisecond);

/// An edit of follow-up mode: a line of the face drawn 3 pixels lower.
void Edit(benchmark::State& state) {
  const SessionCase& c = TheCase();
  const CurveFollower follower(c.predictor);
  const FollowUpStart start = follower.Begin(c.predictor->run().face_template.neutral, Untouched::kFollow);
  SessionLines lines = follower.CurvesOf(start.vertices);
  lines.curves[size_t(state.range(0))].drawn = ++lines.num_drawn;
  for (Eigen::Vector2d& point : lines.curves[size_t(state.range(0))].points) point.y() += 3;
  if (state.range(1) != 0) lines.wrinkles.push_back({.points = {{100, 70}, {150, 72}}});
  for (auto _ : state) benchmark::DoNotOptimize(follower.Follow(start, lines));
}
BENCHMARK(Edit)->Name("edit of the jaw")->Args({0, 0})->Unit(benchmark::kMillisecond);
BENCHMARK(Edit)->Name("edit of a brow")->Args({2, 0})->Unit(benchmark::kMillisecond);
BENCHMARK(Edit)->Name("the same with a wrinkle")->Args({2, 1})->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace daumier::sketch
