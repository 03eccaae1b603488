#pragma once

#include "faces/eyeball.h"
#include "faces/face_model.h"
#include "rig/eye_clearance.h"
#include "rig/morph_targets.h"
#include "rig/seam.h"

#include <algorithm>
#include <string>
#include <vector>

namespace daumier::rig {

/// What a rig turns an eyeball by at eyeLook* = 1, degrees.
inline constexpr double kGazeDegrees = 30;

/// How much of the opening between the lids eyeSquint and eyeLookDown take away at most. Targets add up, so that lids
/// which also blink would cross.
inline constexpr double kSquintNarrows = 0.25, kLookDownNarrows = 0.5;

/// The greatest weight of eyeBlink with which the lids of that eye meet and do not cross, for a player that limits it.
inline double BlinkLimit(double squint, double look_down) {
  return std::max(0.0, 1 - kSquintNarrows * squint - kLookDownNarrows * look_down);
}

/// Makes expressions fit a face where its parts touch: lids over eyeballs, lip on lip. Made once for a source.
///
/// With S the neutral face and o_e the offset of expression e, all at weight 1:
/// - eyeBlink*: the edges of the lids (FindLidEdges) coincide at S + o, over the ball of faces::EyeballFit.
/// - All expressions of an eye (eye*): S + t o is outside the ball at some t up to 1 (EyeSkin::KeepOutside), for eyeLook* outside the
///   ball turned by t kGazeDegrees. A target is a straight way, and the way around a ball is not: closed lids lie
///   farther out than the ball alone would have them.
/// - eyeSquint* and eyeLookDown* leave 1 - kSquintNarrows and 1 - kLookDownNarrows of the opening; the other ones leave
///   all of it.
/// - mouthClose = -o_jawOpen times ShareOfLips, and what brings the inner contours of the lips together at S +
///   o_jawOpen + o_mouthClose; so a part a of both leaves 1 - a of the neutral face's gap.
/// - mouthPress*: the contours meet with both sides pressed.
/// - Other expressions of mouth and jaw: lips do not cross deeper than the neutral face's.
class FaceContact {
 public:
  /// blinks: V x 3 each, the template with its right and its left eye closed; they decide on the edges of the lids.
  /// @throws Error as faces::FindOpenings and FindLidEdges.
  FaceContact(const faces::FaceTemplate& face_template, const geometry::Points& right_blink,
              const geometry::Points& left_blink);

  /// Changes the targets, named as ArkitNames(), of a face (V x 3, cm). On up to `threads` cores.
  void Apply(const geometry::Points& neutral, MorphTargets& targets, unsigned threads) const;

  struct Eye {
    std::string side;  ///< "Right", "Left": the end of the names of its expressions.
    faces::EyeballFit fit;
    EyeSkin skin;
    Seam lids;
    SeamFrame Frame(const geometry::Points& neutral, const faces::Eyeball& eyeball) const;
  };
  const std::vector<Eye>& eyes() const { return eyes_; }
  const Seam& lips() const { return lips_; }
  SeamFrame LipFrame(const geometry::Points& neutral) const;

 private:
  void FitEye(const Eye& eye, const geometry::Points& neutral, MorphTargets& targets) const;
  void FitMouth(const geometry::Points& neutral, MorphTargets& targets) const;

  std::vector<Eye> eyes_;
  Seam lips_;
  Eigen::VectorXf of_lips_, of_left_;  ///< V: ShareOfLips, ShareOfLeftSide.
};

}  // namespace daumier::rig
