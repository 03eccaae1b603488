#include "cli/predict_session.h"

#include "core/error.h"
#include "core/evenly_spaced.h"
#include "core/files.h"
#include "core/log.h"
#include "core/output_place.h"
#include "core/process_task.h"
#include "core/staged_directory.h"
#include "geometry/obj.h"
#include "render/sheet.h"
#include "render/stroke_overlay.h"
#include "render/svg.h"
#include "reports/face_pictures.h"
#include "reports/face_surface.h"
#include "systems/sketch/session_file.h"

#include <fmt/format.h>

#include <memory>
#include <utility>
#include <vector>

namespace daumier::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSessionKind = "session";
constexpr int64_t kMostShown = 24;

/// A state, and what led to it.
struct RecordedState {
  std::string name, caption;
  std::shared_ptr<const sketch::SketchState> state;
  std::vector<render::Stroke> on_canvas;
};

std::shared_ptr<const sketch::SketchPredictor> OpenForSession(const SessionArguments& arguments) {
  std::shared_ptr<const systems::Predictor> opened = sketch::OpenSketchPredictor(arguments.run, arguments.device);
  return std::dynamic_pointer_cast<const sketch::SketchPredictor>(std::move(opened));
}

std::vector<render::Stroke> LinesOnCanvas(const sketch::SketchState& state, const sketch::SessionScript& script) {
  if (state.is_follow_up()) return sketch::StrokesOf(state.lines);
  return render::MapToCanvas(state.strokes, sketch::SheetPlacement({script.width, script.height, {}}));
}

render::Image SheetOfSession(const std::vector<RecordedState>& states, const faces::FaceTemplate& face_template) {
  std::vector<geometry::Points> faces;
  for (const RecordedState& recorded : states)
    if (recorded.state->vertices.rows() > 0) faces.push_back(recorded.state->vertices);
  if (faces.empty()) faces.push_back(face_template.neutral);
  const faces::FinishedHead head = reports::HeadOf(reports::SurfaceOf(face_template), face_template.neutral);
  const render::Frame frame = reports::FrameOfFaces(faces);
  std::vector<render::SheetCell> cells;
  std::vector<RecordedState> shown = EvenlySpaced(states, kMostShown);
  shown.back() = states.back();
  for (const RecordedState& recorded : shown) {
    cells.push_back({render::DrawnWithCurves(recorded.on_canvas, {}, reports::kCell), recorded.caption});
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
  CheckReplacedFolder(arguments.out, kSessionKind, {arguments.session, arguments.run});
  const auto predictor = OpenForSession(arguments);
  const faces::FaceTemplate& face_template = predictor->run().face_template;
  sketch::SketchSession session(predictor, script.width, script.height);
  const Task task = TaskOfProcess();
  std::vector<RecordedState> states;
  ReplayNaming(
      arguments.session, script, session,
      [&](size_t number, std::shared_ptr<const sketch::SketchState> state) {
        const std::string what = sketch::NameOf(script.events[number - 1].what);
        std::vector<render::Stroke> lines = LinesOnCanvas(*state, script);
        states.push_back(
            {fmt::format("{:03}", number), fmt::format("{} {}", number, what), std::move(state), std::move(lines)});
        task.Report(int64_t(number), int64_t(script.events.size()), "events");
      },
      Task(task.stop));  // What a predictor reports of one event is no progress of them all.
  for (const std::string& warning : states.back().state->warnings) log::Warn("the last state: {}", warning);

  StagedDirectory staged(arguments.out, kSessionKind);
  Manifest manifest{.kind = kSessionKind, .verb = "predict"};
  manifest.sources = predictor->run().manifest.sources;
  manifest.details["run_data_hash"] = DataHash(arguments.run);
  const auto add = [&](const std::string& name) { manifest.checksums[name] = Sha256OfFile(staged.path() / name); };
  for (const RecordedState& recorded : states) {
    const std::string drawing = recorded.name + ".svg", mesh = recorded.name + ".obj";
    render::WriteSvg(staged.path() / drawing, recorded.on_canvas, {"line"});
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
  render::WriteImage(staged.path() / "sheet.png", SheetOfSession(states, face_template));
  add("sheet.png");
  WriteFileAtomically(staged.path() / "session.json", sketch::SessionToJson(script).dump(1) + "\n");
  add("session.json");
  manifest.counts = {{"states", states.size()}};
  WriteManifest(staged.path(), manifest);
  staged.Commit();
  fmt::print("session: {} ({} states)\n", arguments.out.string(), states.size());
}

}  // namespace daumier::cli
