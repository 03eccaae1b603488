#pragma once
#include "core/json.h"
#include "systems/sketch/sketch_session.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace daumier::sketch {

/// What a person did, to be done again.
struct SessionEvent {
  enum class What { kDraw, kErase, kFollowUp, kRefine, kOperation, kGesture, kUndo, kRedo };
  What what = What::kDraw;
  CanvasPoints points = {};            ///< Of kDraw, kErase and kGesture: pixels of the sheet.
  Pen pen = {};                        ///< Of kDraw; of kErase its mirror.
  RefinementOperation operation = {};  ///< Of kOperation, with its points; of kGesture its view.
};

/// A recorded session: versioned JSON
///   {"version": 1, "sheet": [width, height], "begin": "mean", "events": [{"do": "draw", "points": [[x, y], ...]}, ...]}
/// begin, if there is one: "mean", the mean neutral face, or the file of a face, next to the session's file; follow-up mode
/// begins with it. do, and what else an event has, or may have (in brackets):
///   draw                     points, [mirror: true or false], [stabiliser: pixels of the sheet],
///                            [weight: pixels of the sheet], [pressure: 0 to 1, one a point, with a weight]
///   erase                    points, [mirror]
///   follow_up, refine, undo, redo
///   region, translate, pull  points, [view: [yaw, pitch] in degrees]
///   brush, unbrush           points, radius: pixels of the sheet, [view]
///   roll                     level: -3 to 3 without 0, [view]
///   gesture                  points, [view]
struct SessionScript {
  static constexpr int kVersion = 1;
  double width = 0, height = 0;  ///< Of the sheet, pixels.
  std::string begin = {};        ///< Empty: with a blank sheet.
  std::vector<SessionEvent> events;
};

/// What to do about a session that cannot be replayed.
inline constexpr const char* kRepairSession = "Repair the file (docs/sketching.md), or record the session again";

/// An event as the file has it. @throws Error saying what is wrong with it.
SessionEvent EventFromJson(const Json& json);
Json EventToJson(const SessionEvent& event);

/// At most kMostEvents events and kMostSessionPoints points in all are read.
inline constexpr size_t kMostEvents = 2'000, kMostSessionPoints = 1'000'000;

/// @throws Error naming the file, the number of the event (the first is 1), what is wrong with it and the repair.
SessionScript ReadSession(const std::filesystem::path& file);
Json SessionToJson(const SessionScript& script);

/// What is reported of an event.
struct ReplayedEvent {
  size_t number = 0;  ///< The first is 1.
  std::shared_ptr<const SketchState> state;
  std::optional<datasets::Gesture> gesture = {};  ///< What a stroke was recognised as, of kGesture.
};

/// Does one event. Returns what a stroke was recognised as, of kGesture. @throws Error as the function of SketchSession.
std::optional<datasets::Gesture> Do(const SessionEvent& event, SketchSession& session, const Task& task = {},
                                    FaceTime when = FaceTime::kAtOnce);

/// Does the events one after the other, those that have no effect (nothing under the eraser) as well, and calls
/// `report` after each. @throws Error naming the event that failed; Cancelled if the task is.
void Replay(const SessionScript& script, SketchSession& session,
            const std::function<void(const ReplayedEvent& event)>& report, const Task& task = {});

/// The same without reports: the session ends in an equal state, with an equal history, in a fraction of the time, as faces of the states
/// before are predicted when they are needed. @throws as Replay.
void Resume(const SessionScript& script, SketchSession& session, const Task& task = {});

/// "draw", ... as in the file.
std::string NameOf(const SessionEvent& event);

}  // namespace daumier::sketch
