#pragma once
#include "geometry/flip_repair.h"
#include "geometry/mesh.h"
#include "geometry/pinned_deformation.h"
#include "systems/sketch/predictor.h"
#include "systems/sketch/session_curves.h"

#include <memory>
#include <vector>

namespace daumier::sketch {

/// What a person's lines say of the rest of a face.
enum class Inference {
  kNone,     ///< Nothing: deformation alone.
  kNetwork,  ///< network(lines) - network(curves of start), as printed.
  kFaces,    ///< E[x - start | known curves] of the run's normal distribution of faces, about the start.
};
/// Where curves are that were never redrawn.
enum class Untouched {
  kStay,    ///< At their lines, as printed: known as redrawn ones are.
  kFollow,  ///< Where the inference has them.
};

/// What curves do where following them exactly turns triangles over.
enum class Agreement {
  kRelaxed,  ///< They give way, as little as turns them back (geometry/flip_repair.h).
  kExact,
};

/// Where follow-up sketching began.
struct FollowUpStart {
  geometry::Points vertices;  ///< V x 3, cm.
  Untouched untouched = Untouched::kStay;
  geometry::Points normals = {};  ///< F x 3: geometry::AreaNormals.
  geometry::Points network = {};  ///< V x 3, of Inference::kNetwork: predicted from the curves of this face.
};

/// Faces that follow redrawn curves [Han et al. 2017, section 5.1]:
///   start + inferred change + depth of (network(lines with wrinkles) - network(lines without)) + d,
/// the third term by Inference::kFaces where there are wrinkles, of which the normal distribution says nothing; d the PinnedDeformation that takes the vertices of curves to their lines in x and y and leaves their depth. So lines
/// in which nothing was redrawn give the start. May be used from several threads.
class CurveFollower {
 public:
  /// @throws Error if the camera of the sketches is in perspective, the run has no normal distribution of faces, or as
  /// PinnedDeformation.
  explicit CurveFollower(std::shared_ptr<const SketchPredictor> predictor, Inference inference = Inference::kFaces,
                         Agreement agreement = Agreement::kRelaxed);

  /// face: V x 3, cm. @throws Error if it has other vertices.
  FollowUpStart Begin(const geometry::Points& face, Untouched untouched) const;
  /// The curves of a face, none erased.
  SessionLines CurvesOf(const geometry::Points& face) const;
  /// Moves curves that were never redrawn to where the face has them.
  void MoveUntouched(const geometry::Points& face, SessionLines& lines) const;

  /// lines: of CurvesOf, redrawn. V x 3, cm.
  geometry::Points Follow(const FollowUpStart& start, const SessionLines& lines) const;
  /// start + inferred change, without d.
  geometry::Points Inferred(const FollowUpStart& start, const SessionLines& lines) const;
  /// The network alone. V x 3, cm.
  geometry::Points NetworkOf(const std::vector<render::Stroke>& on_canvas) const;

  const SketchPredictor& predictor() const { return *predictor_; }

 private:
  geometry::Points Pulled(const FollowUpStart& start, const geometry::Points& face, const SessionLines& lines) const;
  /// How far pins have to move from a face to their lines, K x 3.
  geometry::Points MovesOfPins(const geometry::Points& face, const SessionLines& lines, Untouched untouched) const;
  /// Relaxes a displacement of the pins' solution.
  void Repair(const FollowUpStart& start, const geometry::Points& face, geometry::Points& displacement) const;
  /// What the network sees in wrinkles, V x 3, along the view.
  geometry::Points ChangeOfWrinkles(const SessionLines& lines) const;
  /// The most likely change of the start's faces, V x 3, by the known curves.
  geometry::Points ChangeOfFaces(const FollowUpStart& start, const SessionLines& lines) const;

  std::shared_ptr<const SketchPredictor> predictor_;
  Inference inference_;
  Agreement agreement_;
  std::vector<int> pin_of_point_;  ///< K: which pin the vertex of each curve point is.
  std::unique_ptr<const geometry::PinnedDeformation> deformation_;
  geometry::FlipRepair repair_;
  Eigen::MatrixXd curve_effects_;               ///< K x 2P: what components of faces do to pins on the canvas, pixels.
  std::vector<Eigen::MatrixXd> curve_normals_;  ///< K x K of each curve: the effects on its points by their transpose.
};

}  // namespace daumier::sketch
