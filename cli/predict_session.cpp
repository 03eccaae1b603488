#include "cli/predict_session.h"

#include "cli/rig_face.h"
#include "core/error.h"
#include "core/evenly_spaced.h"
#include "core/files.h"
#include "core/log.h"
#include "core/output_place.h"
#include "core/process_task.h"
#include "core/staged_directory.h"
#include "geometry/alignment.h"
#include "geometry/obj.h"
#include "render/draw.h"
#include "render/shading.h"
#include "render/sheet.h"
#include "render/svg.h"
#include "render/weighted_strokes.h"
#include "reports/face_pictures.h"
#include "reports/face_surface.h"
#include "systems/shipped_weights.h"
#include "systems/sketch/gesture_recogniser.h"
#include "systems/sketch/gesture_run_folder.h"
#include "systems/sketch/session_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

namespace daumier::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSessionKind = "session";
constexpr int64_t kMostShown = 24;
constexpr char kStoppedWhileWriting[] = "stopped while the session was written; nothing is left of it";

/// A state, and what led to it.
struct RecordedState {
  std::string name, caption;
  std::shared_ptr<const sketch::SketchState> state;
  std::vector<render::WeightedStroke> on_canvas;
  const sketch::SessionEvent* event = nullptr;  ///< Null: the session began with it.
};

/// The shipped network of gestures, where a session has any. @throws UsageError if it is not there.
std::shared_ptr<const sketch::GestureRecogniser> OpenGestures(const sketch::SessionScript& script) {
  const auto is_gesture = [](const sketch::SessionEvent& event) {
    return event.what == sketch::SessionEvent::What::kGesture;
  };
  if (std::ranges::none_of(script.events, is_gesture)) return nullptr;
  const std::vector<fs::path> places = systems::WeightsPlaces();
  for (const systems::ShippedWeights& weights : systems::ListWeights(places))
    if (weights.system == sketch::kGestureSystem)
      return std::make_shared<const sketch::GestureRecogniser>(sketch::OpenGestureRecogniser(weights.directory));
  throw UsageError(
      fmt::format("the session has gestures, and there are no weights that recognise them in {}. Restore "
                  "`gestures`, or set DAUMIER_WEIGHTS",
                  places.empty() ? std::string("any folder") : places.front().string()));
}

/// Of a session's folder and `begin`; empty if there is no such file.
fs::path FaceToBeginWith(const SessionArguments& arguments, const sketch::SessionScript& script) {
  if (script.begin.empty() || script.begin == "mean") return {};
  return arguments.session.parent_path() / script.begin;
}

/// @throws Error if a face does not lie as those of the template do.
void CheckPlace(const fs::path& face, const geometry::Points& vertices, const faces::FaceTemplate& face_template) {
  constexpr double kMostShift = 0.25, kMostTurn = 30, kMostDifference = 0.2;  // Of the height, degrees, of the height.
  const double height = (face_template.neutral.col(1).maxCoeff() - face_template.neutral.col(1).minCoeff());
  const geometry::Similarity placed = geometry::AlignSimilarity(face_template.neutral, vertices);
  const double turn = Eigen::AngleAxisd(placed.rotation).angle() * 180 / M_PI;
  const double shift = (vertices.colwise().mean() - face_template.neutral.colwise().mean()).norm();
  const double difference = (placed.Apply(face_template.neutral) - vertices).rowwise().norm().mean();
  DAUMIER_CHECK(
      turn <= kMostTurn && shift <= kMostShift * height && difference <= kMostDifference * height,
      "{} is turned by {:.0f} degrees, moved by {:.1f} cm and differs by {:.1f} cm on average from the mean face "
      "(expected at most {:.0f} degrees, {:.1f} and {:.1f} cm). Export it in the frame and with the vertices of "
      "the template, or begin with another face",
      face.string(), turn, shift, difference, kMostTurn, kMostShift * height, kMostDifference * height);
}

/// Begins follow-up mode with the face that the script names.
void Begin(const SessionArguments& arguments, const sketch::SessionScript& script,
           const faces::FaceTemplate& face_template, sketch::SketchSession& session) {
  if (script.begin.empty()) return;
  if (script.begin == "mean") return session.FollowUp();
  const fs::path face = FaceToBeginWith(arguments, script);
  const geometry::Points vertices =
      ReadFaceOf(face, face_template, "Register it first (`daumier register`), or begin with another face");
  CheckPlace(face, vertices, face_template);
  session.FollowUpFrom(vertices);
}

std::string CaptionOf(const sketch::ReplayedEvent& replayed, const sketch::SessionEvent& event) {
  std::string caption = fmt::format("{} {}", replayed.number, sketch::NameOf(event));
  if (replayed.gesture) caption += ": " + NameOf(*replayed.gesture);
  return caption;
}

std::vector<render::WeightedStroke> LinesOnCanvas(const sketch::SketchState& state,
                                                  const sketch::SessionScript& script) {
  if (state.is_follow_up() || state.is_refinement()) return sketch::WeightedStrokesOf(state.lines);
  return render::MapWeighted(state.strokes, sketch::SheetPlacement({script.width, script.height, {}}));
}

/// Where a view of the refinement mode has a stroke: the face in that view, with handles in blue and the stroke in red.
render::Image ViewOf(const RecordedState& recorded, const faces::FinishedHead& head,
                     const sketch::SketchSession& session, const sketch::SessionScript& script) {
  const sketch::RefinementOperation& operation = recorded.event->operation;
  sketch::SketchState shown = *recorded.state;
  const double factor = reports::kCell / std::max(script.width, script.height);
  shown.frame = render::Composed(shown.frame, {1 / factor});
  render::Camera camera = session.CameraOf(shown, operation.view);
  camera.width = camera.height = reports::kCell;
  render::Image image = render::ToRgb(RenderMesh(reports::InputOf(head, shown.vertices), camera));
  const geometry::Points seen = render::Project(camera, shown.vertices);
  for (const int handle : shown.refinement->handles)
    render::FillRectangle(image, int(seen(handle, 1)) - 1, int(seen(handle, 0)) - 1, 2, 2, {40, 90, 230});
  const sketch::CanvasPoints& points = operation.points.empty() ? recorded.event->points : operation.points;
  if (points.empty()) return image;
  const double length = factor * datasets::LengthOf(points);
  for (const Eigen::Vector2d& point : datasets::Resampled(points, 2 + int(length)))
    render::FillRectangle(image, int(factor * point.y()), int(factor * point.x()), 2, 2, {220, 40, 40});
  return image;
}

/// Whether a face takes part in the scale of the sheet: one with a vertex that was moved far away would make the others dots.
bool IsShown(const geometry::Points& face, const faces::FaceTemplate& face_template) {
  constexpr double kMost = 2;
  const auto extent = [](const geometry::Points& points) -> Eigen::RowVector3d {
    return points.colwise().maxCoeff() - points.colwise().minCoeff();
  };
  return extent(face).maxCoeff() <= kMost * extent(face_template.neutral).maxCoeff();
}

render::Image SheetOfSession(const std::vector<RecordedState>& states, const sketch::SketchSession& session,
                             const sketch::SessionScript& script, const faces::FaceTemplate& face_template,
                             const Task& task) {
  std::vector<geometry::Points> faces;
  for (const RecordedState& recorded : states)
    if (recorded.state->vertices.rows() > 0 && IsShown(recorded.state->vertices, face_template))
      faces.push_back(recorded.state->vertices);
  if (faces.empty()) faces.push_back(face_template.neutral);
  const faces::FinishedHead head = reports::HeadOf(reports::SurfaceOf(face_template), face_template.neutral);
  const render::Frame frame = reports::FrameOfFaces(faces);
  std::vector<render::SheetCell> cells;
  std::vector<RecordedState> shown = EvenlySpaced(states, kMostShown);
  shown.back() = states.back();
  for (const RecordedState& recorded : shown) {
    task.ThrowIfCancelled(kStoppedWhileWriting);
    const bool is_view = recorded.event != nullptr && recorded.state->is_refinement();
    cells.push_back({is_view ? ViewOf(recorded, head, session, script)
                             : render::ToRgb(render::RasteriseWeighted(recorded.on_canvas, reports::kCell)),
                     recorded.caption});
    const bool has_face = recorded.state->vertices.rows() > 0;
    cells.push_back({has_face ? reports::FrontView(head, recorded.state->vertices, frame) : render::Image()});
    cells.push_back({has_face ? reports::SideView(head, recorded.state->vertices, frame) : render::Image()});
  }
  return render::MakeSheet(cells, 6);
}

/// sketch::Replay. @throws Error naming the file and the repair, too.
template <class Report>
void ReplayNaming(const fs::path& file, const sketch::SessionScript& script, sketch::SketchSession& session,
                  const Report& report, const Task& task) {
  try {
    sketch::Replay(script, session, report, task);
  } catch (const Cancelled&) {
    throw;
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}. {}", file.string(), error.what(), sketch::kRepairSession));
  }
}

}  // namespace

void ReplaySession(const SessionArguments& arguments) {
  const sketch::SessionScript script = sketch::ReadSession(arguments.session);
  std::vector<fs::path> inputs = {arguments.session, arguments.run};
  if (const fs::path face = FaceToBeginWith(arguments, script); !face.empty()) inputs.push_back(face);
  CheckReplacedFolder(arguments.out, kSessionKind, inputs);
  const auto predictor = sketch::OpenSessionPredictor(arguments.run, arguments.device);
  const faces::FaceTemplate& face_template = predictor->run().face_template;
  sketch::SketchSession session(predictor, script.width, script.height, OpenGestures(script));
  Begin(arguments, script, face_template, session);
  const Task task = TaskOfProcess();
  std::vector<RecordedState> states;
  if (!script.begin.empty())
    states.push_back({"000", "begin", session.state(), LinesOnCanvas(*session.state(), script)});
  ReplayNaming(
      arguments.session, script, session,
      [&](const sketch::ReplayedEvent& replayed) {
        const sketch::SessionEvent& event = script.events[replayed.number - 1];
        states.push_back({fmt::format("{:03}", replayed.number), CaptionOf(replayed, event), replayed.state,
                          LinesOnCanvas(*replayed.state, script), &event});
        task.Report(int64_t(replayed.number), int64_t(script.events.size()), "events");
      },
      Task(task.stop));  // What a predictor reports of one event is no progress of them all.
  for (const std::string& warning : states.back().state->warnings) log::Warn("the last state: {}", warning);

  StagedDirectory staged(arguments.out, kSessionKind);
  Manifest manifest{.kind = kSessionKind, .verb = "predict"};
  manifest.sources = predictor->run().manifest.sources;
  manifest.details["run_data_hash"] = DataHash(arguments.run);
  const auto add = [&](const std::string& name) { manifest.checksums[name] = Sha256OfFile(staged.path() / name); };
  for (const RecordedState& recorded : states) {
    task.ThrowIfCancelled(kStoppedWhileWriting);
    const std::string drawing = recorded.name + ".svg", mesh = recorded.name + ".obj";
    render::WriteWeightedSvg(staged.path() / drawing, recorded.on_canvas, {"line"});
    add(drawing);
    Json entry = {{"event", recorded.caption},
                  {"canvas_from_sheet", render::PlacementToJson(recorded.state->frame)},
                  {"warnings", recorded.state->warnings}};
    if (recorded.state->vertices.rows() > 0) {
      geometry::WriteObj(staged.path() / mesh, faces::SurfaceMesh(face_template, recorded.state->vertices));
      add(mesh);
    }
    manifest.details["states"].push_back(std::move(entry));
  }
  render::WriteImage(staged.path() / "sheet.png", SheetOfSession(states, session, script, face_template, task));
  add("sheet.png");
  WriteFileAtomically(staged.path() / "session.json", sketch::SessionToJson(script).dump(1) + "\n");
  add("session.json");
  manifest.counts = {{"states", states.size()}};
  WriteManifest(staged.path(), manifest);
  staged.Commit();
  fmt::print("session: {} ({} states)\n", arguments.out.string(), states.size());
}

}  // namespace daumier::cli
