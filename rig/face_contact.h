#pragma once

#include "faces/eyeball.h"
#include "faces/face_model.h"
#include "rig/eye_clearance.h"
#include "rig/morph_targets.h"
#include "rig/seam.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace daumier::rig {

/// What a rig turns an eyeball by at eyeLook* = 1, degrees.
inline constexpr double kGazeDegrees = 30;

/// How much of the opening between the lids eyeSquint and eyeLookDown take away. Targets add up, so that lids which also
/// blink would cross.
inline constexpr double kSquintNarrows = 0.25, kLookDownNarrows = 0.35;

/// How much of jawOpen tongueOut has in it.
inline constexpr double kTongueOpens = 0.3;

/// The greatest weight of eyeBlink with which the lids of that eye meet and do not cross, for a player that limits it.
inline double BlinkLimit(double squint, double look_down) {
  return std::max(0.0, 1 - kSquintNarrows * squint - kLookDownNarrows * look_down);
}

/// Makes expressions fit a face where its parts touch: lids over eyeballs, lip on lip. Made once for a source.
///
/// With S the neutral face, o_e the offset of expression e and B that of an eye's eyeBlink, all at weight 1:
/// - eyeBlink: the edges of the lids (FindLidEdges) coincide at S + B, over the ball of faces::EyeballFit, and over the
///   one that is SetBack, wherever it looks. Of an eye that is less open at rest than the template's, the given offset
///   counts by how much it is open.
/// - eyeSquint, eyeLookDown: they coincide at S + (1 - k) B + o, k = kSquintNarrows, kLookDownNarrows. So they do at any
///   weights s of squint, d of lookDown and BlinkLimit(s, d) of blink.
/// - eyeLookIn, eyeLookOut, and every expression that is none of that eye: they coincide at S + B + o. So lids that blink
///   are closed whatever brows, cheeks, mouth and the other eye do, and nothing but that eye's own expressions changes its
///   opening.
/// - eyeWide, eyeLookUp: they leave all of the opening or widen it.
/// - All of these: S + t o is outside the ball at some t up to 1 (EyeSkin::KeepOutside), for eyeLook* outside the
///   ball turned by t kGazeDegrees. A target is a straight way, and the way around a ball is not: closed lids lie
///   farther out than the ball alone would have them.
/// - mouthClose = -o_jawOpen times ShareOfLips, and what brings the inner contours of the lips together at S +
///   o_jawOpen + o_mouthClose; so a part a of both leaves 1 - a of the neutral face's gap.
/// - mouthPress*: the contours meet with both sides pressed.
/// - jawOpen, mouthFunnel, mouthShrug*, mouthLowerDown*, mouthUpperUp* and noseSneer*: the contours are not nearer to each
///   other, and cross not deeper, than the neutral face's; with pressed lips they do not cross.
/// - The other expressions of mouth, jaw and cheeks leave the contours to each other as they are on the neutral face, but
///   for a seam that tilts, across which they then are not nearer.
/// - tongueOut: kTongueOpens times jawOpen, so that the tongue passes between the lips.
class FaceContact {
 public:
  /// blinks: V x 3 each, the template with its right and its left eye closed; they decide on the edges of the lids.
  /// @throws Error as faces::FindOpenings and FindLidEdges.
  FaceContact(const faces::FaceTemplate& face_template, const geometry::Points& right_blink,
              const geometry::Points& left_blink);

  /// Changes the targets, named as ArkitNames(), of a face (V x 3, cm). On up to `threads` cores.
  void Apply(const geometry::Points& neutral, MorphTargets& targets, unsigned threads) const;

  /// Expressions that Apply reads to change others. A column is the same whatever others hold, if these are as given.
  static const std::vector<std::string_view>& Sources();

  struct Eye {
    std::string side;  ///< "Right", "Left": the end of the names of its expressions.
    faces::EyeballFit fit;
    EyeSkin skin;
    Seam lids;
    double
        open;  ///< Mean height of the upper lid's edge over the lower one on the template, as a share of their width.
    SeamFrame Frame(const geometry::Points& neutral, const faces::Eyeball& eyeball) const;
  };
  const std::vector<Eye>& eyes() const { return eyes_; }
  const Seam& lips() const { return lips_; }
  SeamFrame LipFrame(const geometry::Points& neutral) const;

 private:
  /// What an eye needs of one face.
  struct FittedEye {
    const Eye* eye;
    faces::Eyeball eyeball, anywhere;  ///< As fitted; SetBack, with its cornea wherever it looks.
    SeamFrame frame;
    Eigen::VectorXf blink;  ///< 3V
  };
  FittedEye FitBlink(const Eye& eye, const geometry::Points& neutral, MorphTargets& targets) const;
  Eigen::VectorXf FitLids(const FittedEye& fitted, std::string_view name, const geometry::Points& neutral,
                          const Eigen::VectorXf& offset) const;
  void FitPressedLips(const SeamFrame& frame, const geometry::Points& neutral, MorphTargets& targets) const;
  void FitClosedLips(const SeamFrame& frame, const geometry::Points& neutral, MorphTargets& targets) const;
  Eigen::VectorXf FitLips(const SeamFrame& frame, std::string_view name, const geometry::Points& neutral,
                          const geometry::Points& pressed, const Eigen::VectorXf& offset) const;

  std::vector<Eye> eyes_;
  Seam lips_;
  Eigen::VectorXf of_lips_, of_left_;  ///< V: ShareOfLips, ShareOfLeftSide.
};

}  // namespace daumier::rig
