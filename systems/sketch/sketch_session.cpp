#include "systems/sketch/sketch_session.h"

#include "core/error.h"

#include <algorithm>
#include <utility>

namespace daumier::sketch {
namespace {

render::WeightedStroke StrokeOf(const PenLine& line) {
  render::WeightedStroke stroke;
  for (const Eigen::Vector2d& point : line.points) stroke.points.push_back({float(point.x()), float(point.y())});
  stroke.widths.assign(line.widths.begin(), line.widths.end());
  return stroke;
}

PenLine LineOfStroke(const render::WeightedStroke& stroke) {
  PenLine line;
  for (const auto& [x, y] : stroke.points) line.points.emplace_back(x, y);
  line.widths.assign(stroke.widths.begin(), stroke.widths.end());
  return line;
}

std::vector<render::Stroke> PlainStrokes(const std::vector<render::WeightedStroke>& strokes) {
  return {strokes.begin(), strokes.end()};
}

CanvasPoints OnCanvas(const render::Placement& canvas_from_sheet, const CanvasPoints& points) {
  CanvasPoints mapped;
  for (const Eigen::Vector2d& point : points) mapped.push_back(render::ToCanvas(canvas_from_sheet, point));
  return mapped;
}

PenLine OnCanvas(const render::Placement& canvas_from_sheet, const PenLine& line) {
  PenLine mapped{OnCanvas(canvas_from_sheet, line.points), line.widths};
  for (double& width : mapped.widths) width *= canvas_from_sheet.scale;
  return mapped;
}

/// What an eraser leaves of a stroke: the stroke itself where it does not reach it.
std::vector<render::WeightedStroke> LeftOf(const render::WeightedStroke& stroke, const CanvasPoints& path,
                                           double reach) {
  const PenLine dense = Densified(LineOfStroke(stroke), reach);
  std::vector<render::WeightedStroke> parts;
  PenLine part;
  bool is_cut = false;
  const auto end_part = [&] {
    if (part.points.size() > 1) parts.push_back(StrokeOf(part));
    part = {};
  };
  for (size_t i = 0; i < dense.points.size(); ++i) {
    if (datasets::DistanceTo(path, dense.points[i]) <= reach) {
      is_cut = true;
      end_part();
      continue;
    }
    part.points.push_back(dense.points[i]);
    if (!dense.widths.empty()) part.widths.push_back(dense.widths[i]);
  }
  end_part();
  return is_cut ? parts : std::vector<render::WeightedStroke>{stroke};
}

/// How near the mirror a line ends that meets it, and how near a line's image is that counts as the line, pixels of the canvas.
constexpr double kMirrorReach = 3;

void CheckNotRefined(const SketchState& state) {
  DAUMIER_CHECK(!state.is_refinement(),
                "lines are not drawn or erased while the face is refined: begin follow-up mode first");
}

SketchState WithoutFace(SketchState state) {
  state.vertices = {};
  state.is_pending = true;
  return state;
}

/// The longer side of the sheet, in pixels, is that of the canvas.
render::Placement WholeSheet(double width, double height) {
  return SheetPlacement({width, height, {}});
}

}  // namespace

std::shared_ptr<const SketchPredictor> OpenSessionPredictor(const std::filesystem::path& run, const Device& device) {
  std::shared_ptr<const systems::Predictor> opened = OpenSketchPredictor(run, device, {{"parsing", {{"turn", false}}}});
  return std::dynamic_pointer_cast<const SketchPredictor>(std::move(opened));
}

SketchSession::SketchSession(std::shared_ptr<const SketchPredictor> predictor, double width, double height,
                             std::shared_ptr<const GestureRecogniser> gestures)
    : follower_(std::move(predictor)), width_(width), height_(height), gestures_(std::move(gestures)) {
  DAUMIER_CHECK(std::min(width_, height_) >= 1 && std::max(width_, height_) <= kMostSheet,
                "a sheet of {} x {} pixels, expected sizes from 1 to {}", width_, height_, kMostSheet);
  history_.push_back(std::make_shared<const SketchState>(Blank()));
}

SketchState SketchSession::Blank() const {
  SketchState blank;
  blank.frame = WholeSheet(width_, height_);
  return blank;
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
  if (current_ >= kKeptFaces) {
    StatePointer& old = history_[current_ - kKeptFaces];
    if (old->is_drawn || old->is_refinement()) old = std::make_shared<const SketchState>(WithoutFace(*old));
  }
  if (current_ <= kMostUndo) return;
  history_.erase(history_.begin());
  --current_;
}

bool SketchSession::Step(int by) {
  const std::scoped_lock lock(states_);
  if (by < 0 ? current_ == 0 : current_ + 1 == history_.size()) return false;
  current_ = by < 0 ? current_ - 1 : current_ + 1;
  return true;
}

bool SketchSession::can_undo() const {
  const std::scoped_lock lock(states_);
  return current_ > 0;
}

bool SketchSession::can_redo() const {
  const std::scoped_lock lock(states_);
  return current_ + 1 < history_.size();
}

bool SketchSession::Undo() {
  const std::scoped_lock lock(calls_);
  const bool is_done = Step(-1);
  Settled();
  return is_done;
}

bool SketchSession::Redo() {
  const std::scoped_lock lock(calls_);
  const bool is_done = Step(1);
  Settled();
  return is_done;
}

void SketchSession::Settle(const Task& task) {
  const std::scoped_lock lock(calls_);
  Settled(task);
}

SketchSession::StatePointer SketchSession::Settled(const Task& task) {
  StatePointer now = state();
  if (!now->is_pending) return now;
  SketchState settled = *now;
  settled.is_pending = false;
  if (settled.is_refinement())
    settled.vertices = settled.refinement->vertices;
  else
    settled.is_follow_up() ? Follow(settled, task) : Predict(settled, task);
  now = std::make_shared<const SketchState>(std::move(settled));
  const std::scoped_lock lock(states_);
  history_[current_] = now;
  return now;
}

double SketchSession::MirrorOf(const SketchState& state) const {
  if (!state.is_follow_up()) return width_ / 2;
  const geometry::Points middle = geometry::Points::Zero(1, 3);  // Faces are symmetric about x = 0.
  const geometry::Points seen = render::Project(follower_.predictor().curves().camera, middle);
  return render::ToCanvas(render::Inverse(state.frame), seen.row(0).head<2>().transpose()).x();
}

void SketchSession::Predict(SketchState& state, const Task& task) const {
  if (state.strokes.empty()) return;
  const systems::Input input = render::Drawing{width_, height_, PlainStrokes(state.strokes)};
  try {
    systems::FaceResult face = std::move(follower_.predictor().Predict(std::span(&input, 1), task).front());
    state.vertices = std::move(face.vertices);
    state.frame = face.frame.value_or(state.frame);
    state.warnings = std::move(face.warnings);
    if (face.record.contains("drawn_parts"))
      state.drawn_parts = face.record.at("drawn_parts").get<std::vector<std::string>>();
  } catch (const Cancelled&) {
    throw;
  } catch (const Error& error) {  // Of a few strokes that show no face yet.
    state.warnings = {error.what()};
  }
}

void SketchSession::AddDrawn(SketchState state, FaceTime when, const Task& task) {
  state.is_drawn = !(state.start && state.start->untouched == Untouched::kFollow);  // Such lines depend on the face.
  state.is_pending = when == FaceTime::kWhenNeeded && state.is_drawn;
  if (!state.is_pending) state.is_follow_up() ? Follow(state, task) : Predict(state, task);
  Add(std::move(state));
}

void SketchSession::Draw(const CanvasPoints& path, const Pen& pen, const Task& task, FaceTime when) {
  CheckOnSheet(path);
  DAUMIER_CHECK(pen.weight <= kHeaviest * std::max(width_, height_),
                "a line that is {:g} pixels wide on a sheet of {:g} x {:g} (expected at most {:g})", pen.weight, width_,
                height_, kHeaviest * std::max(width_, height_));
  const PenLine stroke = Stabilised(WithWeight(path, pen), pen.stabiliser);
  const std::scoped_lock lock(calls_);
  const StatePointer now = pen.mirror ? Settled(task) : state();  // A mirror reaches as far as the face is large.
  CheckNotRefined(*now);
  const std::vector<PenLine> drawn = pen.mirror
                                         ? WithMirrorImage(stroke, MirrorOf(*now), kMirrorReach / now->frame.scale)
                                         : std::vector<PenLine>{stroke};
  if (now->is_follow_up()) {
    SketchState next = *now;
    for (const PenLine& one : drawn) {
      const PenLine line = OnCanvas(next.frame, one);
      sketch::Draw(next.lines, line.points, line.widths);
    }
    return AddDrawn(std::move(next), when, task);
  }
  SketchState next = Blank();
  next.strokes = now->strokes;
  for (const PenLine& one : drawn) {
    CheckStroke(one.points);
    next.strokes.push_back(StrokeOf(one));
  }
  AddDrawn(std::move(next), when, task);
}

bool SketchSession::Erase(const CanvasPoints& path, bool mirror, const Task& task, FaceTime when) {
  DAUMIER_CHECK(!path.empty(), "the eraser's path has no point");
  CheckOnSheet(path);
  const std::scoped_lock lock(calls_);
  const StatePointer now = state();
  CheckNotRefined(*now);
  std::vector<CanvasPoints> paths{path};
  if (mirror) paths.push_back(Mirrored(path, MirrorOf(*now)));
  if (now->is_follow_up()) {
    SketchState next = *now;
    bool is_changed = false;
    for (const CanvasPoints& one : paths)
      is_changed = sketch::Erase(next.lines, OnCanvas(next.frame, one)) || is_changed;
    if (is_changed) AddDrawn(std::move(next), when, task);
    return is_changed;
  }
  const double reach = kEraserReach / WholeSheet(width_, height_).scale;
  SketchState next = Blank();
  next.strokes = now->strokes;
  bool is_changed = false;
  for (const CanvasPoints& one : paths) {
    std::vector<render::WeightedStroke> kept;
    for (const render::WeightedStroke& stroke : next.strokes) {
      std::vector<render::WeightedStroke> parts = LeftOf(stroke, one, reach);
      is_changed = is_changed || parts.size() != 1 || parts.front().points != stroke.points;
      std::ranges::move(parts, std::back_inserter(kept));
    }
    next.strokes = std::move(kept);
  }
  if (is_changed) AddDrawn(std::move(next), when, task);
  return is_changed;
}

void SketchSession::FollowUp() {
  Settle();
  const StatePointer now = state();
  if (now->is_follow_up()) return;
  if (now->vertices.rows() > 0) return FollowUpFrom(now->vertices);
  FollowUpFrom(follower_.predictor().run().face_template.neutral, Untouched::kFollow);
}

void SketchSession::FollowUpFrom(const geometry::Points& vertices, Untouched untouched) {
  const std::scoped_lock lock(calls_);
  const StatePointer now = Settled();
  SketchState next;
  next.start = std::make_shared<const FollowUpStart>(follower_.Begin(vertices, untouched));
  next.lines = follower_.CurvesOf(vertices);
  KeepWidths(next.lines, now->lines);
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

const Refinement& SketchSession::OpenRefinement() {
  if (refinement_ == nullptr)
    refinement_ = std::make_unique<const Refinement>(follower_.predictor().run().face_template);
  return *refinement_;
}

SketchState SketchSession::Refined(const SketchState& from, RefinementState refinement) const {
  SketchState next;
  next.frame = from.frame;
  next.vertices = refinement.vertices;
  next.lines = follower_.CurvesOf(next.vertices);
  KeepWidths(next.lines, from.lines);
  next.refinement = std::make_shared<const RefinementState>(std::move(refinement));
  return next;
}

void SketchSession::Refine() {
  const std::scoped_lock lock(calls_);
  const StatePointer now = Settled();
  if (now->is_refinement()) return;
  const bool has_face = now->vertices.rows() > 0;
  Add(Refined(*now,
              OpenRefinement().Begin(has_face ? now->vertices : follower_.predictor().run().face_template.neutral)));
}

render::Camera SketchSession::CameraOf(const SketchState& state, const View& view) const {
  const geometry::Points& neutral = follower_.predictor().run().face_template.neutral;
  const geometry::Vector3 middle = (neutral.colwise().minCoeff() + neutral.colwise().maxCoeff()).transpose() / 2;
  return ViewCamera(follower_.predictor().curves().camera, state.frame, middle, view);
}

SketchState SketchSession::Applied(const SketchState& from, const RefinementOperation& operation) {
  CheckOnSheet(operation.points);
  DAUMIER_CHECK(from.is_refinement(), "an operation of refinement, but refinement has not begun");
  return Refined(from, sketch::Apply(operation, OpenRefinement(), *from.refinement, CameraOf(from, operation.view)));
}

void SketchSession::Apply(const RefinementOperation& operation) {
  const std::scoped_lock lock(calls_);
  Add(Applied(*state(), operation));
}

datasets::Gesture SketchSession::DoGesture(const CanvasPoints& stroke, const View& view) {
  DAUMIER_CHECK(gestures_ != nullptr, "there is no network of gestures. Restore the weights `gestures`");
  CheckOnSheet(stroke);
  const std::scoped_lock lock(calls_);
  const StatePointer now = state();
  DAUMIER_CHECK(now->is_refinement(), "a gesture, but refinement has not begun");
  const datasets::Gesture gesture = gestures_->Recognise(stroke).gesture;
  if (gesture == datasets::Gesture::kLeftArrow || gesture == datasets::Gesture::kRightArrow) {
    Step(gesture == datasets::Gesture::kLeftArrow ? -1 : 1);
    return gesture;
  }
  const auto operation = OperationOf(gesture, stroke, view, !now->refinement->handles.empty());
  Add(operation ? Applied(*now, *operation) : *now);
  return gesture;
}

geometry::Points SketchSession::Preview(const CanvasPoints& stroke) const {
  const StatePointer now = state();
  render::Drawing drawing{width_, height_, PlainStrokes(now->strokes)};
  drawing.strokes.push_back(StrokeOf({stroke}));
  const render::FramedDrawing framed = render::FrameDrawing(drawing);
  return follower_.NetworkOf(render::MapToCanvas(framed.strokes, framed.placement));
}

geometry::Points SketchSession::Preview(const RefinementOperation& operation) const {
  CheckOnSheet(operation.points);
  const StatePointer now = state();
  DAUMIER_CHECK(now->is_refinement(), "an operation of refinement, but refinement has not begun");
  // refinement_ was made before the first such state was.
  return sketch::Apply(operation, *refinement_, *now->refinement, CameraOf(*now, operation.view)).vertices;
}

std::vector<render::WeightedStroke> SketchSession::OnSheet(const SketchState& state) {
  if (!state.is_follow_up() && !state.is_refinement()) return state.strokes;
  return render::MapWeighted(WeightedStrokesOf(state.lines), render::Inverse(state.frame));
}

}  // namespace daumier::sketch
