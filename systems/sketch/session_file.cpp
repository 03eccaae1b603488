#include "systems/sketch/session_file.h"

#include "core/error.h"
#include "core/files.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

namespace daumier::sketch {
namespace {

using Kind = SessionEvent::What;
using Operation = RefinementOperation::What;

/// An event of the file, and what it may have besides 'do'.
struct EventKind {
  std::string_view name;
  Kind what;
  Operation operation;
  std::vector<std::string_view> keys, optional = {};

  bool has(std::string_view key) const { return std::ranges::count(keys, key) + std::ranges::count(optional, key) > 0; }
};

const std::vector<EventKind>& EventKinds() {
  static const std::vector<EventKind> kinds = {
      {"draw", Kind::kDraw, {}, {"points"}, {"mirror", "stabiliser", "weight", "pressure"}},
      {"erase", Kind::kErase, {}, {"points"}, {"mirror"}},
      {"follow_up", Kind::kFollowUp, {}, {}},
      {"refine", Kind::kRefine, {}, {}},
      {"region", Kind::kOperation, Operation::kRegion, {"points"}, {"view"}},
      {"brush", Kind::kOperation, Operation::kBrush, {"points", "radius"}, {"view"}},
      {"unbrush", Kind::kOperation, Operation::kUnbrush, {"points", "radius"}, {"view"}},
      {"translate", Kind::kOperation, Operation::kTranslate, {"points"}, {"view"}},
      {"roll", Kind::kOperation, Operation::kRoll, {"level"}, {"view"}},
      {"pull", Kind::kOperation, Operation::kPull, {"points"}, {"view"}},
      {"gesture", Kind::kGesture, {}, {"points"}, {"view"}},
      {"undo", Kind::kUndo, {}, {}},
      {"redo", Kind::kRedo, {}, {}},
  };
  return kinds;
}

const EventKind& KindOf(const SessionEvent& event) {
  return *std::ranges::find_if(EventKinds(), [&](const EventKind& kind) {
    return kind.what == event.what && (event.what != Kind::kOperation || kind.operation == event.operation.what);
  });
}

constexpr size_t kMostShown = 60;     // Characters.
constexpr double kMostDegrees = 360;  // Of a view.

/// The value in a message: of a long one the beginning.
std::string Shown(const Json& json) {
  const std::string text = json.dump(-1, ' ', /*ensure_ascii=*/true, Json::error_handler_t::replace);
  return text.size() <= kMostShown ? text : text.substr(0, kMostShown) + "...";
}

double FiniteNumber(const Json& json) {
  DAUMIER_CHECK(json.is_number() && std::isfinite(json.get<double>()), "{} is no number", Shown(json));
  return json.get<double>();
}

Eigen::Vector2d PointFrom(const Json& json) {
  DAUMIER_CHECK(json.is_array() && json.size() == 2, "{} is no pair [x, y]", Shown(json));
  return {FiniteNumber(json[0]), FiniteNumber(json[1])};
}

CanvasPoints PointsFrom(const Json& json) {
  DAUMIER_CHECK(json.is_array() && !json.empty(), "'points' is {}, expected [[x, y], ...]", Shown(json));
  CanvasPoints points;
  for (const Json& point : json) points.push_back(PointFrom(point));
  return points;
}

double WeightFrom(const Json& json) {
  const double weight = FiniteNumber(json);
  DAUMIER_CHECK(weight > 0, "'weight' is {} (expected a positive number)", Shown(json));
  return weight;
}

std::vector<double> PressureFrom(const Json& json) {
  DAUMIER_CHECK(json.is_array() && !json.empty(), "'pressure' is {}, expected a number from 0 to 1 for each point",
                Shown(json));
  std::vector<double> pressure;
  for (const Json& number : json) pressure.push_back(FiniteNumber(number));
  return pressure;
}

int LevelFrom(const Json& json) {
  const double level = FiniteNumber(json);
  DAUMIER_CHECK(level == std::round(level) && level != 0 && std::abs(level) <= 3,
                "'level' is {} (expected -3 to 3 without 0)", Shown(json));
  return int(level);
}

/// An event has what its kind has, and nothing else.
void CheckKeys(const EventKind& kind, const Json& json) {
  for (const std::string_view key : kind.keys) DAUMIER_CHECK(json.contains(key), "'{}' has no '{}'", kind.name, key);
  for (const auto& [key, value] : json.items())
    DAUMIER_CHECK(key == "do" || kind.has(key), "'{}' takes no '{}'", kind.name, key.substr(0, kMostShown));
}

}  // namespace

SessionEvent EventFromJson(const Json& json) {
  DAUMIER_CHECK(json.is_object() && json.contains("do") && json.at("do").is_string(), "it has no text 'do'");
  const auto name = json.at("do").get<std::string>();
  const auto known = std::ranges::find(EventKinds(), name, &EventKind::name);
  if (known == EventKinds().end()) {
    std::vector<std::string_view> names;
    for (const EventKind& kind : EventKinds()) names.push_back(kind.name);
    throw Error(fmt::format("{} is unknown (expected {})", Shown(json.at("do")), fmt::join(names, ", ")));
  }
  CheckKeys(*known, json);
  SessionEvent event{.what = known->what};
  event.operation.what = known->operation;
  CanvasPoints points = json.contains("points") ? PointsFrom(json.at("points")) : CanvasPoints();
  (event.what == Kind::kOperation ? event.operation.points : event.points) = std::move(points);
  if (json.contains("mirror")) {
    DAUMIER_CHECK(json.at("mirror").is_boolean(), "'mirror' is {} (expected true or false)", Shown(json.at("mirror")));
    event.pen.mirror = json.at("mirror").get<bool>();
  }
  if (json.contains("stabiliser")) event.pen.stabiliser = FiniteNumber(json.at("stabiliser"));
  if (json.contains("weight")) event.pen.weight = WeightFrom(json.at("weight"));
  if (json.contains("pressure")) event.pen.pressure = PressureFrom(json.at("pressure"));
  WithWeight(event.points, event.pen);  // Throws what is wrong with them.
  if (json.contains("radius")) event.operation.radius = FiniteNumber(json.at("radius"));
  if (json.contains("level")) event.operation.level = LevelFrom(json.at("level"));
  if (json.contains("view")) {
    const Eigen::Vector2d view = PointFrom(json.at("view"));
    DAUMIER_CHECK(view.cwiseAbs().maxCoeff() <= kMostDegrees, "'view' is {} (expected at most {} degrees)",
                  Shown(json.at("view")), kMostDegrees);
    event.operation.view = {view.x(), view.y()};
  }
  return event;
}

Json EventToJson(const SessionEvent& event) {
  const EventKind& kind = KindOf(event);
  const RefinementOperation& operation = event.operation;
  Json json = {{"do", kind.name}};
  for (const Eigen::Vector2d& point : event.what == Kind::kOperation ? operation.points : event.points)
    json["points"].push_back({point.x(), point.y()});
  if (event.pen.mirror) json["mirror"] = true;
  if (event.pen.stabiliser != 0) json["stabiliser"] = event.pen.stabiliser;
  if (event.pen.weight != 0) json["weight"] = event.pen.weight;
  if (!event.pen.pressure.empty()) json["pressure"] = event.pen.pressure;
  if (kind.has("radius")) json["radius"] = operation.radius;
  if (kind.has("level")) json["level"] = operation.level;
  const View& view = operation.view;
  if (view.yaw_degrees != 0 || view.pitch_degrees != 0) json["view"] = {view.yaw_degrees, view.pitch_degrees};
  return json;
}

namespace {

SessionScript ScriptFrom(const Json& json) {
  DAUMIER_CHECK(json.is_object() && json.contains("version"), "it has no 'version'");
  DAUMIER_CHECK(json.at("version") == SessionScript::kVersion, "version {} (this program reads {})",
                Shown(json.at("version")), SessionScript::kVersion);
  SessionScript script;
  for (const auto& [key, value] : json.items())
    DAUMIER_CHECK(key == "version" || key == "sheet" || key == "begin" || key == "events",
                  "'{}' is unknown (expected version, sheet, begin and events)", key.substr(0, kMostShown));
  const Json sheet = json.value("sheet", Json());
  DAUMIER_CHECK(sheet.is_array() && sheet.size() == 2, "'sheet' is {}, expected [width, height]", Shown(sheet));
  const Eigen::Vector2d size = PointFrom(sheet);
  DAUMIER_CHECK(size.minCoeff() >= 1 && size.maxCoeff() <= SketchSession::kMostSheet,
                "'sheet' is {}, expected sizes from 1 to {}", Shown(sheet), SketchSession::kMostSheet);
  script.width = size.x(), script.height = size.y();
  const Json begin = json.value("begin", Json(""));
  DAUMIER_CHECK(begin.is_string(), "'begin' is {} (expected \"mean\", or the file of a face)", Shown(begin));
  script.begin = begin.get<std::string>();
  const Json events = json.value("events", Json());
  DAUMIER_CHECK(events.is_array() && !events.empty() && events.size() <= kMostEvents,
                "'events' is no list of 1 to {} events", kMostEvents);
  size_t num_points = 0;
  for (size_t i = 0; i < events.size(); ++i) {
    try {
      script.events.push_back(EventFromJson(events[i]));
      num_points += script.events.back().points.size() + script.events.back().operation.points.size();
      DAUMIER_CHECK(num_points <= kMostSessionPoints, "there are more than {} points up to it", kMostSessionPoints);
    } catch (const Error& error) {
      throw Error(fmt::format("event {}: {}", i + 1, error.what()));
    }
  }
  return script;
}

}  // namespace

std::optional<datasets::Gesture> Do(const SessionEvent& event, SketchSession& session, const Task& task,
                                    FaceTime when) {
  switch (event.what) {
    case Kind::kDraw:
      session.Draw(event.points, event.pen, task, when);
      break;
    case Kind::kErase:
      session.Erase(event.points, event.pen.mirror, task, when);
      break;
    case Kind::kFollowUp:
      session.FollowUp();
      break;
    case Kind::kRefine:
      session.Refine();
      break;
    case Kind::kOperation:
      session.Apply(event.operation);
      break;
    case Kind::kGesture:
      return session.DoGesture(event.points, event.operation.view);
    case Kind::kUndo:
      session.Undo();
      break;
    case Kind::kRedo:
      session.Redo();
      break;
  }
  return std::nullopt;
}

SessionScript ReadSession(const std::filesystem::path& file) {
  DAUMIER_CHECK(std::filesystem::is_regular_file(file), "{}: no regular file. Name a recorded session", file.string());
  const std::string text = ReadFile(file);
  try {
    return ScriptFrom(ParseJson(text, "the session"));
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}. {}", file.string(), error.what(), kRepairSession));
  }
}

Json SessionToJson(const SessionScript& script) {
  Json json = {{"version", SessionScript::kVersion}, {"sheet", {script.width, script.height}}};
  if (!script.begin.empty()) json["begin"] = script.begin;
  json["events"] = Json::array();
  for (const SessionEvent& event : script.events) json["events"].push_back(EventToJson(event));
  return json;
}

namespace {

/// Do for each event. @throws Error naming the event; Cancelled.
void DoAll(const SessionScript& script, SketchSession& session, FaceTime when, const Task& task,
           const std::function<void(const ReplayedEvent&)>& report) {
  for (size_t i = 0; i < script.events.size(); ++i) {
    task.ThrowIfCancelled("stopped before event {} of {}", i + 1, script.events.size());
    ReplayedEvent replayed{.number = i + 1, .state = nullptr};
    try {
      replayed.gesture = Do(script.events[i], session, task, when);
    } catch (const Cancelled&) {
      throw;
    } catch (const Error& error) {
      throw Error(fmt::format("event {} ({}): {}", i + 1, NameOf(script.events[i]), error.what()));
    }
    replayed.state = session.state();
    report(replayed);
  }
}

}  // namespace

void Replay(const SessionScript& script, SketchSession& session,
            const std::function<void(const ReplayedEvent& event)>& report, const Task& task) {
  DoAll(script, session, FaceTime::kAtOnce, task, report);
}

void Resume(const SessionScript& script, SketchSession& session, const Task& task) {
  DoAll(script, session, FaceTime::kWhenNeeded, task, [](const ReplayedEvent&) {});
  session.Settle(task);
}

std::string NameOf(const SessionEvent& event) {
  return std::string(KindOf(event).name);
}

}  // namespace daumier::sketch
