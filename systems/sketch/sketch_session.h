#pragma once
#include "core/task.h"
#include "geometry/mesh.h"
#include "render/framing.h"
#include "systems/sketch/curve_follower.h"
#include "systems/sketch/gesture_recogniser.h"
#include "systems/sketch/refinement_operation.h"
#include "systems/sketch/session_pen.h"

#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace daumier::sketch {

/// A moment of a session. Immutable, shared between threads.
struct SketchState {
  std::vector<render::WeightedStroke> strokes;        ///< Of initial mode, in pixels of the sheet.
  std::shared_ptr<const FollowUpStart> start;         ///< Of follow-up mode alone.
  std::shared_ptr<const RefinementState> refinement;  ///< Of refinement mode alone.
  SessionLines lines;                                 ///< Of both: curves of the face on the canvas.
  render::Placement frame;               ///< Sheet to canvas, where the camera of the sketches sees the face.
  geometry::Points vertices;             ///< V x 3, cm; empty while there is no face.
  std::vector<std::string> warnings;     ///< Of the face.
  std::vector<std::string> drawn_parts;  ///< Of initial mode: DrawnParts.
  bool is_drawn = false;                 ///< The face is that of the lines, and can be predicted again.
  bool is_pending = false;               ///< The face is not there, until it is needed.

  bool is_follow_up() const { return start != nullptr; }
  bool is_refinement() const { return refinement != nullptr; }
};

/// When the face of a new state is predicted. A session that is resumed needs the face of its last state, and others only if they
/// are undone to.
enum class FaceTime { kAtOnce, kWhenNeeded };

/// A face while a person draws it [Han et al. 2017, sections 3.1, 3.2 and 5.1]. In initial mode all strokes are predicted
/// as `daumier predict` does. In follow-up mode the feature curves of the face are lines that are erased and redrawn
/// (session_curves.h), which the face follows (curve_follower.h). In refinement mode regions, handles and silhouettes of
/// the face are moved in any view (refinement.h), by operations or by gestures that mean them. Each call makes a new state or throws and changes
/// nothing. May be used from several threads: calls wait for each other, and state() for none of them.
class SketchSession {
 public:
  static constexpr double kMostSheet = 100'000;  ///< Pixels a side.
  static constexpr double kFarthest = 10;        ///< Sheets' longer sides that a point may be away from the origin.
  static constexpr double kHeaviest = 0.1;       ///< Share of the longer side that a line may be wide.
  static constexpr size_t kMostUndo = 100;       ///< Steps that can be undone; earlier states are dropped.
  static constexpr size_t kKeptFaces = 16;       ///< Latest states that keep their faces; others make them again.

  /// gestures: null where none are recognised. sheet: width x height, pixels. @throws Error if a size is not from 1 to kMostSheet, or the predictor has no parser.
  SketchSession(std::shared_ptr<const SketchPredictor> predictor, double width, double height,
                std::shared_ptr<const GestureRecogniser> gestures = nullptr);

  std::shared_ptr<const SketchState> state() const;

  /// What a pen draws along a path, in pixels of the sheet. With a mirror also the image of it, by the middle of the
  /// sheet, in follow-up mode by that of the face. In initial mode a sheet that shows no face has a state without a face.
  /// The face depends on the path alone, the pen's weight is kept for drawings: a redrawn line keeps it, also while the face is refined.
  /// @throws Error as WithWeight, Stabilised and sketch::Draw, if a point lies farther away than kFarthest, the line is heavier than
  /// kHeaviest, or in refinement mode; Cancelled if the task is.
  /// With FaceTime::kWhenNeeded the state may be pending until Settle, a step of undo or another mode.
  void Draw(const CanvasPoints& path, const Pen& pen = {}, const Task& task = {}, FaceTime when = FaceTime::kAtOnce);
  /// In initial mode what lies within kEraserReach of the path, in follow-up mode as sketch::Erase, in pixels of the
  /// canvas in both; with `mirror` also what its image erases. False, without a new state, if that is nothing.
  /// @throws Error as Draw.
  bool Erase(const CanvasPoints& path, bool mirror = false, const Task& task = {}, FaceTime when = FaceTime::kAtOnce);
  /// Predicts the face of a pending state. @throws Cancelled if the task is.
  void Settle(const Task& task = {});
  /// Follow-up mode, from the current face, whose lines stay where they were drawn or refined, or, where there is none,
  /// from the mean neutral face, whose lines follow until they are redrawn.
  void FollowUp();
  /// The same from a given face, V x 3, cm. @throws Error if it has other vertices.
  void FollowUpFrom(const geometry::Points& vertices, Untouched untouched = Untouched::kStay);
  /// Refinement mode, from the current face, or else from the mean neutral one.
  void Refine();
  /// Begins refinement mode where it is not yet. @throws Error as sketch::Apply, or as CheckOnSheet.
  void Apply(const RefinementOperation& operation);
  /// Recognises a stroke and does what it means (OperationOf); arrows undo and redo. In refinement mode alone. Any
  /// other stroke than the ten gestures makes an equal state. Returns what it was. @throws Error without gestures, in another mode, or as Apply.
  datasets::Gesture DoGesture(const CanvasPoints& stroke, const View& view);
  /// False where there is nothing to undo or redo. The last kMostUndo steps can be undone.
  bool Undo();
  bool Redo();
  bool can_undo() const;
  bool can_redo() const;

  /// While the pen is down: the face of the network alone, for the strokes of initial mode and this one. V x 3, cm.
  geometry::Points Preview(const CanvasPoints& stroke) const;
  /// The same in refinement mode: the face that Apply would make. @throws Error as Apply.
  geometry::Points Preview(const RefinementOperation& operation) const;

  /// Sees the face of a state as a view of its sheet shows it. The face turns about the middle of the template.
  render::Camera CameraOf(const SketchState& state, const View& view) const;
  /// The lines of a state on the sheet, in pixels: strokes, or curves and wrinkles.
  static std::vector<render::WeightedStroke> OnSheet(const SketchState& state);

 private:
  void CheckOnSheet(const CanvasPoints& points) const;

  using StatePointer = std::shared_ptr<const SketchState>;

  void Add(SketchState state);
  /// Where a mirror is, x in pixels of the sheet.
  double MirrorOf(const SketchState& state) const;
  const Refinement& OpenRefinement();
  SketchState Refined(const SketchState& from, RefinementState refinement) const;
  /// Calls are locked. @throws Error as Apply.
  SketchState Applied(const SketchState& from, const RefinementOperation& operation);
  bool Step(int by);
  SketchState Blank() const;
  /// The face of the strokes. @throws Cancelled if the task is.
  void Predict(SketchState& state, const Task& task) const;
  /// The face of the lines. @throws Cancelled if the task is.
  void Follow(SketchState& state, const Task& task) const;
  /// A state of new strokes or lines.
  void AddDrawn(SketchState state, FaceTime when, const Task& task);
  /// The current state with its face. Calls are locked.
  StatePointer Settled(const Task& task = {});

  const CurveFollower follower_;
  const double width_, height_;
  const std::shared_ptr<const GestureRecogniser> gestures_;
  std::unique_ptr<const Refinement> refinement_;  ///< Made when it is first needed.
  std::mutex calls_;                              ///< Held by a call that makes a state.
  mutable std::mutex states_;                     ///< Held for moments.
  std::vector<StatePointer> history_;
  size_t current_ = 0;
};

/// The predictor of sessions: as OpenSketchPredictor, without a search for turned drawings, which costs unfinished ones three more
/// parses; people draw upright on a screen.
std::shared_ptr<const SketchPredictor> OpenSessionPredictor(const std::filesystem::path& run, const Device& device);

}  // namespace daumier::sketch
