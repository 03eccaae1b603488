#include "systems/sketch/sketch_session.h"

#include "core/error.h"
#include "geometry/coordinates.h"
#include "geometry/operators.h"

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
    const bool is_erased = DistanceToLine(point, path) <= reach;
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
    : predictor_(std::move(predictor)), width_(width), height_(height) {
  DAUMIER_CHECK(width_ > 0 && height_ > 0, "a sheet of {} x {} pixels, expected positive sizes", width_, height_);
  const faces::FaceTemplate& face_template = predictor_->run().face_template;
  const fitting::ProjectedCurves& curves = predictor_->curves();
  DAUMIER_CHECK(!curves.camera.perspective, "the camera of the sketches is in perspective");
  std::vector<int> pins;
  for (const int vertex : curves.vertices) {
    const auto known = std::ranges::find(pins, vertex);
    pin_of_point_.push_back(int(known - pins.begin()));
    if (known == pins.end()) pins.push_back(vertex);
  }
  deformation_ = std::make_unique<geometry::PinnedDeformation>(
      geometry::UniformLaplacian(face_template.triangles, face_template.num_vertices()), std::move(pins));
  SketchState blank;
  blank.frame = WholeSheet(width_, height_);
  history_.push_back(std::make_shared<const SketchState>(std::move(blank)));
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
    systems::FaceResult face = std::move(predictor_->Predict(std::span(&input, 1), task).front());
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
  const Eigen::VectorXf& mean = predictor_->run().models.gaussian.mean;
  FollowUpFrom(now->vertices.rows() > 0 ? now->vertices
                                        : geometry::PointsFrom(std::span(mean.data(), size_t(mean.size()))));
}

void SketchSession::FollowUpFrom(const geometry::Points& vertices) {
  const faces::FaceTemplate& face_template = predictor_->run().face_template;
  DAUMIER_CHECK(vertices.rows() == face_template.num_vertices(), "a face of {} vertices, expected {}", vertices.rows(),
                face_template.num_vertices());
  const std::scoped_lock lock(calls_);
  const StatePointer now = state();
  SketchState next;
  const bool is_own = now->vertices.rows() == vertices.rows() && now->vertices == vertices;
  next.frame = is_own ? now->frame : WholeSheet(width_, height_);
  next.vertices = vertices;
  const Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor> single = vertices.cast<float>();
  const std::vector<float> projected =
      fitting::Project(predictor_->curves(), std::span(single.data(), size_t(single.size())));
  next.lines = LinesOf(face_template, predictor_->run().feature_curves, predictor_->curves().offsets, projected);
  next.start = std::make_shared<const FollowUpStart>(FollowUpStart{vertices, NetworkOf(StrokesOf(next.lines))});
  Add(std::move(next));
}

geometry::Points SketchSession::NetworkOf(const std::vector<render::Stroke>& on_canvas) const {
  return geometry::PointsFrom(predictor_->FromStrokes({on_canvas}).front().vertices);
}

void SketchSession::Follow(SketchState& state, const Task& task) const {
  task.ThrowIfCancelled("stopped before the face was predicted");
  const geometry::Points network = NetworkOf(StrokesOf(state.lines));
  task.ThrowIfCancelled("stopped before the face was complete");
  state.vertices = Pulled(state.start->vertices + (network - state.start->network), state.lines);
}

geometry::Points SketchSession::Pulled(const geometry::Points& face, const SessionLines& lines) const {
  const render::Camera& camera = predictor_->curves().camera;
  const geometry::Points projected = render::Project(camera, face);
  const std::vector<int>& pins = deformation_->pins();
  geometry::Points moves(Eigen::Index(pins.size()), 3);
  std::vector<int> drawn(pins.size(), -1);  // Of a vertex of several curves the last one drawn counts.
  size_t point = 0;
  for (const SessionCurve& curve : lines.curves) {
    for (const Eigen::Vector2d& target : curve.points) {
      const int pin = pin_of_point_[point++];
      if (curve.drawn <= drawn[size_t(pin)]) continue;
      drawn[size_t(pin)] = curve.drawn;
      Eigen::Vector3d in_camera = Eigen::Vector3d::Zero();
      in_camera.head<2>() = (target - projected.row(pins[size_t(pin)]).head<2>().transpose()) / camera.scale;
      moves.row(pin) = (camera.camera_from_world.transpose() * in_camera).transpose();
    }
  }
  return face + deformation_->Solve(moves);
}

geometry::Points SketchSession::Preview(const CanvasPoints& stroke) const {
  const StatePointer now = state();
  render::Drawing drawing{width_, height_, now->strokes};
  drawing.strokes.push_back(StrokeOf(stroke));
  const render::FramedDrawing framed = render::FrameDrawing(drawing);
  return NetworkOf(render::MapToCanvas(framed.strokes, framed.placement));
}

std::vector<render::Stroke> SketchSession::OnSheet(const SketchState& state) {
  if (!state.is_follow_up()) return state.strokes;
  return render::MapToCanvas(StrokesOf(state.lines), render::Inverse(state.frame));
}

}  // namespace daumier::sketch
