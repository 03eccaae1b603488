#include "systems/sketch/sketch_session.h"

#include "core/error.h"

#include <algorithm>
#include <utility>

namespace daumier::sketch {
namespace {

render::Stroke StrokeOf(const CanvasPoints& points) {
  render::Stroke stroke;
  for (const Eigen::Vector2d& point : points) stroke.points.push_back({float(point.x()), float(point.y())});
  return stroke;
}

CanvasPoints PointsOfStroke(const render::Stroke& stroke) {
  CanvasPoints points;
  for (const auto& [x, y] : stroke.points) points.emplace_back(x, y);
  return points;
}

CanvasPoints OnCanvas(const render::Placement& canvas_from_sheet, const CanvasPoints& points) {
  CanvasPoints mapped;
  for (const Eigen::Vector2d& point : points) mapped.push_back(render::ToCanvas(canvas_from_sheet, point));
  return mapped;
}

/// The line with points at most `step` apart.
CanvasPoints Densified(const CanvasPoints& line, double step) {
  CanvasPoints dense{line.front()};
  for (size_t i = 1; i < line.size(); ++i) {
    const int count = int((line[i] - line[i - 1]).norm() / step) + 1;
    for (int k = 1; k <= count; ++k) dense.push_back(line[i - 1] + double(k) / count * (line[i] - line[i - 1]));
  }
  return dense;
}

/// What an eraser leaves of a stroke: the stroke itself where it does not reach it.
std::vector<render::Stroke> LeftOf(const render::Stroke& stroke, const CanvasPoints& path, double reach) {
  const CanvasPoints dense = Densified(PointsOfStroke(stroke), reach);
  std::vector<render::Stroke> parts;
  CanvasPoints part;
  bool is_cut = false;
  const auto end_part = [&] {
    if (part.size() > 1) parts.push_back(StrokeOf(part));
    part.clear();
  };
  for (const Eigen::Vector2d& point : dense) {
    const bool is_erased = datasets::DistanceTo(path, point) <= reach;
    is_cut = is_cut || is_erased;
    is_erased ? end_part() : part.push_back(point);
  }
  end_part();
  return is_cut ? parts : std::vector<render::Stroke>{stroke};
}

/// The longer side of the sheet, in pixels, is that of the canvas.
render::Placement WholeSheet(double width, double height) {
  return SheetPlacement({width, height, {}});
}

}  // namespace

SketchSession::SketchSession(std::shared_ptr<const SketchPredictor> predictor, double width, double height)
    : follower_(std::move(predictor)), width_(width), height_(height) {
  DAUMIER_CHECK(std::min(width_, height_) >= 1 && std::max(width_, height_) <= kMostSheet,
                "a sheet of {} x {} pixels, expected sizes from 1 to {}", width_, height_, kMostSheet);
  SketchState blank;
  blank.frame = WholeSheet(width_, height_);
  history_.push_back(std::make_shared<const SketchState>(std::move(blank)));
}

void SketchSession::CheckOnSheet(const CanvasPoints& points) const {
  const double farthest = kFarthest * std::max(width_, height_);
  for (const Eigen::Vector2d& point : points)
    DAUMIER_CHECK(point.cwiseAbs().maxCoeff() <= farthest,
                  "the point ({:g}, {:g}) lies far outside the sheet of {:g} x {:g}", point.x(), point.y(), width_,
                  height_);
}

std::shared_ptr<const SketchState> SketchSession::state() const {
  const std::scoped_lock lock(states_);
  return history_[current_];
}

void SketchSession::Add(SketchState state) {
  const std::scoped_lock lock(states_);
  history_.resize(current_ + 1);
  history_.push_back(std::make_shared<const SketchState>(std::move(state)));
  ++current_;
}

bool SketchSession::Undo() {
  const std::scoped_lock lock(calls_, states_);
  if (current_ == 0) return false;
  --current_;
  return true;
}

bool SketchSession::Redo() {
  const std::scoped_lock lock(calls_, states_);
  if (current_ + 1 == history_.size()) return false;
  ++current_;
  return true;
}

SketchState SketchSession::Predicted(std::vector<render::Stroke> strokes, const Task& task) const {
  SketchState next;
  next.frame = WholeSheet(width_, height_);
  next.strokes = std::move(strokes);
  if (next.strokes.empty()) return next;
  const systems::Input input = render::Drawing{width_, height_, next.strokes};
  try {
    systems::FaceResult face = std::move(follower_.predictor().Predict(std::span(&input, 1), task).front());
    next.vertices = std::move(face.vertices);
    next.frame = face.frame.value_or(next.frame);
    next.warnings = std::move(face.warnings);
  } catch (const Cancelled&) {
    throw;
  } catch (const Error& error) {  // Of a few strokes that show no face yet.
    next.warnings = {error.what()};
  }
  return next;
}

void SketchSession::Draw(const CanvasPoints& stroke, const Task& task) {
  CheckOnSheet(stroke);
  const std::scoped_lock lock(calls_);
  const StatePointer now = state();
  if (now->is_follow_up()) {
    SketchState next = *now;
    sketch::Draw(next.lines, OnCanvas(next.frame, stroke));
    Follow(next, task);
    return Add(std::move(next));
  }
  CheckStroke(stroke);
  std::vector<render::Stroke> strokes = now->strokes;
  strokes.push_back(StrokeOf(stroke));
  Add(Predicted(std::move(strokes), task));
}

bool SketchSession::Erase(const CanvasPoints& path, const Task& task) {
  DAUMIER_CHECK(!path.empty(), "the eraser's path has no point");
  CheckOnSheet(path);
  const std::scoped_lock lock(calls_);
  const StatePointer now = state();
  if (now->is_follow_up()) {
    SketchState next = *now;
    if (!sketch::Erase(next.lines, OnCanvas(next.frame, path))) return false;
    Follow(next, task);
    Add(std::move(next));
    return true;
  }
  const double reach = kEraserReach / WholeSheet(width_, height_).scale;
  std::vector<render::Stroke> left;
  bool is_changed = false;
  for (const render::Stroke& stroke : now->strokes) {
    std::vector<render::Stroke> parts = LeftOf(stroke, path, reach);
    is_changed = is_changed || parts.size() != 1 || parts.front().points != stroke.points;
    std::ranges::move(parts, std::back_inserter(left));
  }
  if (is_changed) Add(Predicted(std::move(left), task));
  return is_changed;
}

void SketchSession::FollowUp() {
  const StatePointer now = state();
  if (now->is_follow_up()) return;
  if (now->vertices.rows() > 0) return FollowUpFrom(now->vertices);
  FollowUpFrom(follower_.predictor().run().face_template.neutral, Untouched::kFollow);
}

void SketchSession::FollowUpFrom(const geometry::Points& vertices, Untouched untouched) {
  const std::scoped_lock lock(calls_);
  const StatePointer now = state();
  SketchState next;
  next.start = std::make_shared<const FollowUpStart>(follower_.Begin(vertices, untouched));
  next.lines = follower_.CurvesOf(vertices);
  const bool is_own = now->vertices.rows() == vertices.rows() && now->vertices == vertices;
  next.frame = is_own ? now->frame : WholeSheet(width_, height_);
  next.vertices = vertices;
  Add(std::move(next));
}

void SketchSession::Follow(SketchState& state, const Task& task) const {
  task.ThrowIfCancelled("stopped before the face was predicted");
  state.vertices = follower_.Follow(*state.start, state.lines);
  if (state.start->untouched == Untouched::kFollow) follower_.MoveUntouched(state.vertices, state.lines);
}

geometry::Points SketchSession::Preview(const CanvasPoints& stroke) const {
  const StatePointer now = state();
  render::Drawing drawing{width_, height_, now->strokes};
  drawing.strokes.push_back(StrokeOf(stroke));
  const render::FramedDrawing framed = render::FrameDrawing(drawing);
  return follower_.NetworkOf(render::MapToCanvas(framed.strokes, framed.placement));
}

std::vector<render::Stroke> SketchSession::OnSheet(const SketchState& state) {
  if (!state.is_follow_up()) return state.strokes;
  return render::MapToCanvas(StrokesOf(state.lines), render::Inverse(state.frame));
}

}  // namespace daumier::sketch
