#include "systems/sketch/session_file.h"

#include "core/error.h"
#include "core/files.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace daumier::sketch {
namespace {

using What = SessionEvent::What;

constexpr std::array<std::pair<const char*, What>, 5> kEventNames = {{{"draw", What::kDraw},
                                                                      {"erase", What::kErase},
                                                                      {"follow_up", What::kFollowUp},
                                                                      {"undo", What::kUndo},
                                                                      {"redo", What::kRedo}}};

bool HasPoints(What what) {
  return what == What::kDraw || what == What::kErase;
}

/// The value in a message: of a long one the beginning.
std::string Shown(const Json& json) {
  constexpr size_t kMostShown = 60;
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

SessionEvent EventFrom(const Json& json) {
  DAUMIER_CHECK(json.is_object() && json.contains("do") && json.at("do").is_string(), "it has no text 'do'");
  const auto name = json.at("do").get<std::string>();
  const auto known = std::ranges::find_if(kEventNames, [&](const auto& entry) { return name == entry.first; });
  DAUMIER_CHECK(known != kEventNames.end(), "{} is unknown (expected draw, erase, follow_up, undo or redo)",
                Shown(json.at("do")));
  SessionEvent event{known->second, {}};
  const Json points = json.value("points", Json::array());
  DAUMIER_CHECK(points.is_array() && points.empty() != HasPoints(event.what), "'{}' has {} points", name,
                points.is_array() ? std::to_string(points.size()) : "malformed");
  for (const Json& point : points) event.points.push_back(PointFrom(point));
  return event;
}

SessionScript ScriptFrom(const Json& json) {
  DAUMIER_CHECK(json.is_object() && json.contains("version"), "it has no 'version'");
  DAUMIER_CHECK(json.at("version") == SessionScript::kVersion, "version {} (this program reads {})",
                Shown(json.at("version")), SessionScript::kVersion);
  SessionScript script;
  const Json sheet = json.value("sheet", Json());
  DAUMIER_CHECK(sheet.is_array() && sheet.size() == 2, "'sheet' is {}, expected [width, height]", Shown(sheet));
  const Eigen::Vector2d size = PointFrom(sheet);
  script.width = size.x(), script.height = size.y();
  const Json events = json.value("events", Json());
  DAUMIER_CHECK(events.is_array() && !events.empty() && events.size() <= kMostEvents,
                "'events' is no list of 1 to {} events", kMostEvents);
  size_t num_points = 0;
  for (size_t i = 0; i < events.size(); ++i) {
    try {
      script.events.push_back(EventFrom(events[i]));
      num_points += script.events.back().points.size();
      DAUMIER_CHECK(num_points <= kMostSessionPoints, "there are more than {} points up to it", kMostSessionPoints);
    } catch (const Error& error) {
      throw Error(fmt::format("event {}: {}", i + 1, error.what()));
    }
  }
  return script;
}

void Do(const SessionEvent& event, SketchSession& session, const Task& task) {
  switch (event.what) {
    case What::kDraw:
      return session.Draw(event.points, task);
    case What::kErase:
      session.Erase(event.points, task);
      return;
    case What::kFollowUp:
      return session.FollowUp();
    case What::kUndo:
      session.Undo();
      return;
    case What::kRedo:
      session.Redo();
      return;
  }
}

}  // namespace

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
  Json events = Json::array();
  for (const SessionEvent& event : script.events) {
    Json json = {{"do", NameOf(event.what)}};
    for (const Eigen::Vector2d& point : event.points) json["points"].push_back({point.x(), point.y()});
    events.push_back(std::move(json));
  }
  return {
      {"version", SessionScript::kVersion}, {"sheet", {script.width, script.height}}, {"events", std::move(events)}};
}

void Replay(const SessionScript& script, SketchSession& session,
            const std::function<void(size_t number, std::shared_ptr<const SketchState> state)>& report,
            const Task& task) {
  for (size_t i = 0; i < script.events.size(); ++i) {
    task.ThrowIfCancelled("stopped before event {} of {}", i + 1, script.events.size());
    try {
      Do(script.events[i], session, task);
    } catch (const Cancelled&) {
      throw;
    } catch (const Error& error) {
      throw Error(fmt::format("event {} ({}): {}", i + 1, NameOf(script.events[i].what), error.what()));
    }
    report(i + 1, session.state());
  }
}

std::string NameOf(SessionEvent::What what) {
  return std::ranges::find(kEventNames, what, &std::pair<const char*, What>::second)->first;
}

}  // namespace daumier::sketch
