#pragma once
#include "core/task.h"
#include "geometry/mesh.h"
#include "render/framing.h"
#include "systems/sketch/curve_follower.h"

#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace daumier::sketch {

/// A moment of a session. Immutable, shared between threads.
struct SketchState {
  std::vector<render::Stroke> strokes;         ///< Of initial mode, in pixels of the sheet.
  std::shared_ptr<const FollowUpStart> start;  ///< Null in initial mode.
  SessionLines lines;                          ///< Of follow-up mode, on the canvas.
  render::Placement frame;                     ///< Sheet to canvas, where the camera of the sketches sees the face.
  geometry::Points vertices;                   ///< V x 3, cm; empty while there is no face.
  std::vector<std::string> warnings;           ///< Of the face.

  bool is_follow_up() const { return start != nullptr; }
};

/// A face while a person draws it [Han et al. 2017, sections 3.1, 3.2 and 5.1]. In initial mode all strokes are predicted
/// as `daumier predict` does. In follow-up mode the feature curves of the face are lines that are erased and redrawn
/// (session_curves.h), which the face follows (curve_follower.h). Each call makes a new state or throws and changes
/// nothing. May be used from several threads: calls wait for each other, and state() for none of them.
class SketchSession {
 public:
  static constexpr double kMostSheet = 100'000;  ///< Pixels a side.
  static constexpr double kFarthest = 10;        ///< Sheets' longer sides that a point may be away from the origin.

  /// sheet: width x height, pixels. @throws Error if a size is not from 1 to kMostSheet, or the predictor has no parser.
  SketchSession(std::shared_ptr<const SketchPredictor> predictor, double width, double height);

  std::shared_ptr<const SketchState> state() const;

  /// A stroke, in pixels of the sheet. In initial mode a sheet that shows no face has a state without a face.
  /// @throws Error as sketch::Draw, or if a point lies farther away than kFarthest; Cancelled if the task is.
  void Draw(const CanvasPoints& stroke, const Task& task = {});
  /// In initial mode what lies within kEraserReach of the path, in follow-up mode as sketch::Erase, in pixels of the
  /// canvas in both. False, without a new state, if that is nothing.
  bool Erase(const CanvasPoints& path, const Task& task = {});
  /// Follow-up mode, from the current face, whose lines stay where they were drawn, or, where there is none, from the
  /// mean neutral face, whose lines follow until they are redrawn.
  void FollowUp();
  /// The same from a given face, V x 3, cm. @throws Error if it has other vertices.
  void FollowUpFrom(const geometry::Points& vertices, Untouched untouched = Untouched::kStay);
  /// False where there is nothing to undo or redo.
  bool Undo();
  bool Redo();

  /// While the pen is down: the face of the network alone, for the strokes of initial mode and this one. V x 3, cm.
  geometry::Points Preview(const CanvasPoints& stroke) const;

  /// The lines of a state on the sheet, in pixels: strokes, or curves and wrinkles.
  static std::vector<render::Stroke> OnSheet(const SketchState& state);

 private:
  void CheckOnSheet(const CanvasPoints& points) const;

  using StatePointer = std::shared_ptr<const SketchState>;

  void Add(SketchState state);
  SketchState Predicted(std::vector<render::Stroke> strokes, const Task& task) const;
  /// The face of the lines. @throws Cancelled if the task is.
  void Follow(SketchState& state, const Task& task) const;

  const CurveFollower follower_;
  const double width_, height_;
  std::mutex calls_;           ///< Held by a call that makes a state.
  mutable std::mutex states_;  ///< Held for moments.
  std::vector<StatePointer> history_;
  size_t current_ = 0;
};

}  // namespace daumier::sketch
