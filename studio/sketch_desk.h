#pragma once
#include "core/json.h"
#include "studio/session_text.h"
#include "studio/workspace.h"
#include "systems/sketch/session_file.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

namespace daumier::studio {

/// What a new session begins with.
struct NewSession {
  std::string name = {};
  geometry::Points begin = {};          ///< A face, V x 3, cm: follow-up mode begins with it.
  bool begins_with_mean = false;        ///< The mean neutral face instead.
  sketch::SessionScript recorded = {};  ///< Events that are done at once; its sheet, if it has any.
};

/// Drawing sessions on disk: of each a folder s-NNNN with session.json, as `daumier predict --session` reads it, about.json {name,
/// sheet, begin}, and begin.obj of one that begins with a face. A session is written after each event, atomically: a program that is
/// killed loses at most the event that it was doing. At most kMostOpen are in memory; others are replayed when they are needed.
/// Thread-safe: calls of one session wait for each other.
class SketchDesk {
 public:
  static constexpr size_t kMostOpen = 8;
  static constexpr double kSheet = 512;  ///< Pixels a side of a new sheet.

  /// gestures: null where none are recognised.
  SketchDesk(const std::filesystem::path& folder, std::shared_ptr<const sketch::SketchPredictor> predictor,
             std::shared_ptr<const sketch::GestureRecogniser> gestures);

  /// [{id, name, events, changed}, ...], changed in seconds since 1970, the last changed first.
  Json List() const;
  /// Returns the id. @throws Error if the face or an event is wrong, or the recorded session begins with a file; nothing is left then.
  std::string Add(const NewSession& begin);
  bool Has(std::string_view id) const;
  void Remove(std::string_view id);                         ///< @throws NotFound.
  void Rename(std::string_view id, std::string_view name);  ///< @throws NotFound.
  std::filesystem::path FileOf(std::string_view id) const;  ///< session.json. @throws NotFound, also without events.
  bool HasEvents(std::string_view id) const;                ///< Whether there is such a file. @throws NotFound.

  /// What the page shows of a session (docs/studio.md). @throws NotFound; Error if its file is damaged.
  Json State(std::string_view id);
  /// Does an event, appends it to the file, and returns the state with `changed` (whether there was anything to act on),
  /// `gesture` (of a gesture, what it was) and `milliseconds`. @throws NotFound; Error as sketch::EventFromJson and sketch::Do,
  /// or if the session is full (sketch::kMostEvents, kMostSessionPoints).
  Json Do(std::string_view id, const Json& event) { return DoAndSee(id, event).state; }
  /// The same with the face of that state, whatever other calls do meanwhile.
  struct SeenState {
    Json state;
    geometry::Points face;  ///< V x 3, cm; no rows where there is none.
  };
  SeenState DoAndSee(std::string_view id, const Json& event);

  /// V x 3, cm; no rows while there is no face. @throws NotFound.
  geometry::Points Face(std::string_view id);
  /// The strokes of a session in initial mode, in pixels of its sheet; none in other modes. @throws NotFound.
  std::vector<render::WeightedStroke> DrawnStrokes(std::string_view id);
  /// SketchSession::Preview of an event that draws a stroke, or of an operation of refinement. @throws NotFound; Error if it is another
  /// event, the stroke has no extent, or as SketchSession::Apply.
  geometry::Points Preview(std::string_view id, const sketch::SessionEvent& event);
  /// 3 x 4: sheet pixels and depth (cm) of a point (x, y, z, 1) as the view shows it. @throws NotFound.
  Eigen::Matrix<double, 3, 4> PixelFromCm(std::string_view id, const sketch::View& view);

 private:
  struct OpenSession {
    std::mutex reading;                              ///< Of what is read from the file, until `session` is there.
    std::unique_ptr<sketch::SketchSession> session;  ///< Null: not read yet.
    std::mutex mutex;                                ///< Of all below, once it is there.
    std::string name;
    sketch::SessionScript script;
    std::optional<SessionText> text;
    size_t num_points = 0;  ///< Of all events.
    int64_t revision = 0;
  };
  /// Of an open session, or one that is read and replayed, while other sessions are used. The last that were used stay open.
  std::shared_ptr<OpenSession> Open(std::string_view id);
  /// Closes those that were used the longest ago and that no call is at. mutex_ is locked.
  void CloseOld();
  void Read(const std::filesystem::path& folder, OpenSession& open) const;
  /// Does what is recorded, and keeps it. The script is given.
  void Replay(const geometry::Points& begin, OpenSession& open) const;
  std::unique_ptr<sketch::SketchSession> Begin(const sketch::SessionScript& script,
                                               const geometry::Points& begin) const;
  Json StateOf(std::string_view id, const OpenSession& open) const;

  const std::shared_ptr<const sketch::SketchPredictor> predictor_;
  const std::shared_ptr<const sketch::GestureRecogniser> gestures_;
  mutable std::mutex mutex_;  ///< Of all below.
  NumberedFolders folders_;
  std::list<std::pair<std::string, std::shared_ptr<OpenSession>>> open_;  ///< The last used first.
};

}  // namespace daumier::studio
