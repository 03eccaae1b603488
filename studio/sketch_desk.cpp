#include "studio/sketch_desk.h"

#include "core/error.h"
#include "core/files.h"
#include "core/stopwatch.h"
#include "geometry/obj.h"
#include "studio/api.h"
#include "studio/sketch_state_json.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <utility>

namespace daumier::studio {
namespace {

namespace fs = std::filesystem;

constexpr char kSession[] = "session.json", kAbout[] = "about.json", kBegin[] = "begin.obj", kUntitled[] = "Untitled";

Json AboutOf(const std::string& name, const sketch::SessionScript& script) {
  return {{"name", name}, {"sheet", {script.width, script.height}}, {"begin", script.begin}};
}

int64_t SecondsOf(fs::file_time_type changed) {
  const auto time = std::chrono::file_clock::to_sys(changed);
  return std::chrono::duration_cast<std::chrono::seconds>(time.time_since_epoch()).count();
}

size_t NumPoints(const sketch::SessionEvent& event) {
  return event.points.size() + event.operation.points.size();
}

/// What about.json holds.
struct SessionAbout {
  std::string name;
  std::array<double, 2> sheet;
  std::string begin;
};

SessionAbout ReadAbout(const fs::path& file) {
  const Json json = ReadJson(file);
  try {
    return {json.at("name").get<std::string>(), json.at("sheet").get<std::array<double, 2>>(),
            json.at("begin").get<std::string>()};
  } catch (const Json::exception& error) {
    throw Error(fmt::format("{}: {}. Remove the session", file.string(), TextOf(error)));
  }
}

void WriteJson(const fs::path& file, const Json& json) {
  WriteFileAtomically(file, json.dump(1) + "\n");
}

/// What a list says of a session.
struct ListedSession {
  std::string name;
  size_t events = 0;
  fs::file_time_type changed;
};

/// Nothing of a folder that holds no session, or is being removed.
std::optional<ListedSession> ListedIn(const fs::path& folder) {
  try {
    if (!fs::is_regular_file(folder / kAbout)) return std::nullopt;
    const Json about = TryParseJson(ReadFile(folder / kAbout)).value_or(Json());
    if (!about.is_object() || !about.value("name", Json()).is_string()) return std::nullopt;
    const fs::path file = folder / kSession;
    if (!fs::is_regular_file(file))
      return ListedSession{about.at("name").get<std::string>(), 0, fs::last_write_time(folder / kAbout)};
    const Json recorded = TryParseJson(ReadFile(file)).value_or(Json());
    const size_t events = recorded.is_object() ? recorded.value("events", Json::array()).size() : 0;
    return ListedSession{about.at("name").get<std::string>(), events, fs::last_write_time(file)};
  } catch (const Error&) {
    return std::nullopt;
  } catch (const fs::filesystem_error&) {
    return std::nullopt;
  }
}

}  // namespace

SketchDesk::SketchDesk(const fs::path& folder, std::shared_ptr<const sketch::SketchPredictor> predictor,
                       std::shared_ptr<const sketch::GestureRecogniser> gestures)
    : predictor_(std::move(predictor)), gestures_(std::move(gestures)), folders_(folder, 's') {}

Json SketchDesk::List() const {
  std::vector<std::pair<std::string, fs::path>> folders;
  {
    const std::scoped_lock lock(mutex_);
    for (const std::string& id : folders_.Names()) folders.emplace_back(id, folders_.Of(id));
  }
  std::vector<std::pair<fs::file_time_type, Json>> sessions;
  for (const auto& [id, folder] : folders) {
    const std::optional<ListedSession> listed = ListedIn(folder);
    if (!listed) continue;
    sessions.emplace_back(
        listed->changed,
        Json{{"id", id}, {"name", listed->name}, {"events", listed->events}, {"changed", SecondsOf(listed->changed)}});
  }
  std::ranges::stable_sort(sessions, std::ranges::greater(), &std::pair<fs::file_time_type, Json>::first);
  Json list = Json::array();
  for (auto& [changed, session] : sessions) list.push_back(std::move(session));
  return list;
}

std::unique_ptr<sketch::SketchSession> SketchDesk::Begin(const sketch::SessionScript& script,
                                                         const geometry::Points& begin) const {
  auto session = std::make_unique<sketch::SketchSession>(predictor_, script.width, script.height, gestures_);
  if (begin.rows() > 0)
    session->FollowUpFrom(begin);
  else if (!script.begin.empty())
    session->FollowUp();
  return session;
}

std::string SketchDesk::Add(const NewSession& begin) {
  auto open = std::make_shared<OpenSession>();
  const std::string& recorded_begin = begin.recorded.begin;
  DAUMIER_CHECK(
      recorded_begin.empty() || recorded_begin == "mean",
      "the session begins with the face of a file, '{}', which is not in it. Begin with that face, or replay it "
      "by `daumier predict --session`",
      recorded_begin.substr(0, 40));
  open->name = KeptName(begin.name, kUntitled);
  open->script = begin.recorded;
  if (open->script.width == 0) open->script.width = open->script.height = kSheet;
  open->script.begin = begin.begin.rows() > 0 ? kBegin : begin.begins_with_mean ? "mean" : begin.recorded.begin;
  Replay(begin.begin, *open);

  const std::scoped_lock lock(mutex_);
  const std::string id = folders_.Add();
  const fs::path folder = folders_.Of(id);
  if (begin.begin.rows() > 0)
    geometry::WriteObj(folder / kBegin, faces::SurfaceMesh(predictor_->run().face_template, begin.begin));
  if (!open->script.events.empty()) WriteFileAtomically(folder / kSession, open->text->text());
  WriteJson(folder / kAbout, AboutOf(open->name, open->script));
  open_.emplace_front(id, std::move(open));
  CloseOld();
  return id;
}

void SketchDesk::Replay(const geometry::Points& begin, OpenSession& open) const {
  auto session = Begin(open.script, begin);
  sketch::Resume(open.script, *session);
  open.text.emplace(open.script);
  open.revision = int64_t(open.script.events.size());
  open.num_points = 0;
  for (const sketch::SessionEvent& event : open.script.events) open.num_points += NumPoints(event);
  open.session = std::move(session);
}

void SketchDesk::Read(const fs::path& folder, OpenSession& open) const {
  const SessionAbout about = ReadAbout(folder / kAbout);
  open.name = about.name;
  if (fs::is_regular_file(folder / kSession)) {
    open.script = sketch::ReadSession(folder / kSession);
  } else {
    open.script = {.width = about.sheet[0], .height = about.sheet[1], .begin = about.begin, .events = {}};
  }
  geometry::Points begin;
  if (open.script.begin == kBegin)
    begin = geometry::ParseObjVertices(ReadFile(folder / kBegin), (folder / kBegin).string(),
                                       predictor_->run().face_template.num_vertices());
  Replay(begin, open);
}

std::shared_ptr<SketchDesk::OpenSession> SketchDesk::Open(std::string_view id) {
  std::shared_ptr<OpenSession> open;
  fs::path folder;
  {
    const std::scoped_lock lock(mutex_);
    folder = folders_.Of(id);
    const auto found = std::ranges::find(open_, id, &std::pair<std::string, std::shared_ptr<OpenSession>>::first);
    if (found != open_.end())
      open_.splice(open_.begin(), open_, found);
    else
      open_.emplace_front(id, std::make_shared<OpenSession>());
    open = open_.front().second;
    CloseOld();
  }
  const std::scoped_lock reading(open->reading);
  if (!open->session) Read(folder, *open);  // What fails is tried again by the next call.
  return open;
}

void SketchDesk::CloseOld() {
  for (auto place = open_.end(); place != open_.begin() && open_.size() > kMostOpen;) {
    --place;
    if (place->second.use_count() == 1) place = open_.erase(place);
  }
}

bool SketchDesk::Has(std::string_view id) const {
  const std::scoped_lock lock(mutex_);
  return folders_.Has(id);
}

void SketchDesk::Remove(std::string_view id) {
  const std::scoped_lock lock(mutex_);
  folders_.Remove(id);
  std::erase_if(open_, [&](const auto& open) { return open.first == id; });
}

void SketchDesk::Rename(std::string_view id, std::string_view name) {
  const std::shared_ptr<OpenSession> open = Open(id);
  const std::scoped_lock session_lock(open->mutex);
  open->name = KeptName(name, kUntitled);
  const std::scoped_lock lock(mutex_);
  WriteJson(folders_.Of(id) / kAbout, AboutOf(open->name, open->script));
}

fs::path SketchDesk::FileOf(std::string_view id) const {
  const std::scoped_lock lock(mutex_);
  fs::path file = folders_.Of(id) / kSession;
  if (!fs::is_regular_file(file)) throw NotFound("nothing has been drawn in this session yet");
  return file;
}

bool SketchDesk::HasEvents(std::string_view id) const {
  const std::scoped_lock lock(mutex_);
  return fs::is_regular_file(folders_.Of(id) / kSession);
}

Json SketchDesk::StateOf(std::string_view id, const OpenSession& open) const {
  Json json = {
      {"id", id}, {"name", open.name}, {"revision", open.revision}, {"sheet", {open.script.width, open.script.height}}};
  json.update(SketchStateJson(*open.session->state()));
  json["can_undo"] = open.session->can_undo();
  json["can_redo"] = open.session->can_redo();
  return json;
}

Json SketchDesk::State(std::string_view id) {
  const std::shared_ptr<OpenSession> open = Open(id);
  const std::scoped_lock lock(open->mutex);
  return StateOf(id, *open);
}

SketchDesk::SeenState SketchDesk::DoAndSee(std::string_view id, const Json& json) {
  const Stopwatch watch;
  const std::shared_ptr<OpenSession> open = Open(id);
  sketch::SessionEvent event = sketch::EventFromJson(json);
  const std::scoped_lock lock(open->mutex);
  DAUMIER_CHECK(open->script.events.size() < sketch::kMostEvents,
                "the session has {} events, which is the most. Begin another one with this face", sketch::kMostEvents);
  DAUMIER_CHECK(open->num_points + NumPoints(event) <= sketch::kMostSessionPoints,
                "the session has {} points, and the stroke is too long for it. Begin another one with this face",
                open->num_points);
  const auto before = open->session->state();
  const auto gesture = sketch::Do(event, *open->session);
  const bool is_changed = open->session->state() != before;
  if (is_changed) {
    open->num_points += NumPoints(event);
    open->text->Append(event);
    open->script.events.push_back(std::move(event));
    ++open->revision;
    const fs::path folder = [&] {
      const std::scoped_lock desk(mutex_);
      return folders_.Of(id);
    }();
    WriteFileAtomically(folder / kSession, open->text->text());
  }
  Json state = StateOf(id, *open);
  state["changed"] = is_changed;
  if (gesture) state["gesture"] = datasets::NameOf(*gesture);
  state["milliseconds"] = 1e3 * watch.seconds();
  return {std::move(state), open->session->state()->vertices};
}

geometry::Points SketchDesk::Face(std::string_view id) {
  return Open(id)->session->state()->vertices;
}

std::vector<render::WeightedStroke> SketchDesk::DrawnStrokes(std::string_view id) {
  return Open(id)->session->state()->strokes;
}

geometry::Points SketchDesk::Preview(std::string_view id, const sketch::SessionEvent& event) {
  using enum sketch::SessionEvent::What;
  if (event.what == kOperation) return Open(id)->session->Preview(event.operation);
  DAUMIER_CHECK(event.what == kDraw, "'{}' has no preview", sketch::NameOf(event));
  sketch::CheckStroke(event.points);
  return Open(id)->session->Preview(event.points);
}

Eigen::Matrix<double, 3, 4> SketchDesk::PixelFromCm(std::string_view id, const sketch::View& view) {
  const std::shared_ptr<OpenSession> open = Open(id);
  const render::Camera camera = open->session->CameraOf(*open->session->state(), view);
  Eigen::Matrix<double, 3, 4> matrix;
  matrix << camera.camera_from_world, camera.translation;
  matrix.topRows(2) *= camera.scale;
  matrix.col(3).head<2>() += camera.principal_point;
  return matrix;
}

}  // namespace daumier::studio
