#pragma once
#include <array>
#include <cstdint>
#include <string_view>

/// The words of parsed drawings: what a line shows, the points of a face, states and views.
namespace daumier::faces {

/// What a line of a drawing shows. Outer contours of the lips are kUpperLip and kLowerLip; the line between closed
/// lips, the inner contours of open ones, teeth and tongue are kInnerMouth. A closed eye's line is kUpperLid. Lines of
/// lids above the eye, cheeks and forehead are kWrinkle; beards and moustaches are kHair, shoulders kNeck; hats,
/// glasses, lashes, clothes, jewellery, shading and marks of the page are kOther.
enum class LineLabel {
  kSilhouette,
  kEar,
  kBrow,
  kUpperLid,
  kLowerLid,
  kIris,
  kNose,
  kUpperLip,
  kLowerLip,
  kInnerMouth,
  kWrinkle,
  kHair,
  kNeck,
  kOther
};
inline constexpr int kNumLineLabels = 14;

/// "silhouette", "ear", ... in the order of LineLabel.
extern const std::array<std::string_view, kNumLineLabels> kLineLabelNames;
/// A colour of each for pictures, red, green, blue; they differ from each other.
std::array<uint8_t, 3> ColourOf(LineLabel label);

/// Points of a face as hand-labelled drawings have them: right is the face's own right side, on the left of a frontal
/// picture. The first kNumLandmarkPoints are landmarks; the centres of the eyes are where an eye without corners is.
enum class FacePoint {
  kEyeRightOuter,
  kEyeRightInner,
  kEyeRightTop,
  kEyeRightBottom,
  kEyeLeftInner,
  kEyeLeftOuter,
  kEyeLeftTop,
  kEyeLeftBottom,
  kBrowRightOuter,
  kBrowRightInner,
  kBrowLeftInner,
  kBrowLeftOuter,
  kNoseBottom,
  kNoseWingRight,
  kNoseWingLeft,
  kMouthRight,
  kMouthLeft,
  kLipTop,
  kLipBottom,
  kInnerTop,
  kInnerBottom,
  kChin,
  kContourRight,
  kContourLeft,
  kEyeRightCentre,
  kEyeLeftCentre
};
inline constexpr int kNumFacePoints = 26;
inline constexpr int kNumLandmarkPoints = 24;

/// "eye_right_outer", ... in the order of FacePoint.
extern const std::array<std::string_view, kNumFacePoints> kFacePointNames;
/// The point that the mirror image of a face has there: an involution.
FacePoint MirroredPoint(FacePoint point);

enum class MouthState { kClosed, kOpen, kTeeth };
enum class EyeState { kOpen, kClosed };
/// kThreeQuarterLeft looks to the left of the picture.
enum class DrawnView { kFront, kThreeQuarterLeft, kThreeQuarterRight, kProfile };
inline constexpr int kNumMouthStates = 3, kNumEyeStates = 2, kNumDrawnViews = 4;

/// "closed", "open", "teeth"; "open", "closed"; "front", "three-quarter-left", "three-quarter-right", "profile".
extern const std::array<std::string_view, kNumMouthStates> kMouthStateNames;
extern const std::array<std::string_view, kNumEyeStates> kEyeStateNames;
extern const std::array<std::string_view, kNumDrawnViews> kDrawnViewNames;

}  // namespace daumier::faces
