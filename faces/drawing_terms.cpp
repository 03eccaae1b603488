#include "faces/drawing_terms.h"

namespace daumier::faces {

const std::array<std::string_view, kNumLineLabels> kLineLabelNames = {
    "silhouette", "ear",       "brow",        "upper_lid", "lower_lid", "iris", "nose",
    "upper_lip",  "lower_lip", "inner_mouth", "wrinkle",   "hair",      "neck", "other"};

const std::array<std::string_view, kNumFacePoints> kFacePointNames = {"eye_right_outer",  "eye_right_inner",
                                                                      "eye_right_top",    "eye_right_bottom",
                                                                      "eye_left_inner",   "eye_left_outer",
                                                                      "eye_left_top",     "eye_left_bottom",
                                                                      "brow_right_outer", "brow_right_inner",
                                                                      "brow_left_inner",  "brow_left_outer",
                                                                      "nose_bottom",      "nose_wing_right",
                                                                      "nose_wing_left",   "mouth_right",
                                                                      "mouth_left",       "lip_top",
                                                                      "lip_bottom",       "inner_top",
                                                                      "inner_bottom",     "chin",
                                                                      "contour_right",    "contour_left",
                                                                      "eye_right_centre", "eye_left_centre"};

const std::array<std::string_view, kNumMouthStates> kMouthStateNames = {"closed", "open", "teeth"};
const std::array<std::string_view, kNumEyeStates> kEyeStateNames = {"open", "closed"};
const std::array<std::string_view, kNumDrawnViews> kDrawnViewNames = {"front", "three-quarter-left",
                                                                      "three-quarter-right", "profile"};

std::array<uint8_t, 3> ColourOf(LineLabel label) {
  static constexpr std::array<std::array<uint8_t, 3>, kNumLineLabels> kColours = {{{20, 20, 20},
                                                                                   {150, 90, 30},
                                                                                   {120, 60, 160},
                                                                                   {0, 90, 220},
                                                                                   {0, 180, 230},
                                                                                   {10, 30, 120},
                                                                                   {0, 150, 60},
                                                                                   {220, 20, 40},
                                                                                   {255, 110, 130},
                                                                                   {160, 0, 90},
                                                                                   {150, 170, 40},
                                                                                   {240, 150, 0},
                                                                                   {110, 130, 140},
                                                                                   {190, 190, 190}}};
  return kColours[static_cast<size_t>(label)];
}

FacePoint MirroredPoint(FacePoint point) {
  using enum FacePoint;
  switch (point) {
    case kEyeRightOuter:
      return kEyeLeftOuter;
    case kEyeRightInner:
      return kEyeLeftInner;
    case kEyeRightTop:
      return kEyeLeftTop;
    case kEyeRightBottom:
      return kEyeLeftBottom;
    case kEyeLeftInner:
      return kEyeRightInner;
    case kEyeLeftOuter:
      return kEyeRightOuter;
    case kEyeLeftTop:
      return kEyeRightTop;
    case kEyeLeftBottom:
      return kEyeRightBottom;
    case kBrowRightOuter:
      return kBrowLeftOuter;
    case kBrowRightInner:
      return kBrowLeftInner;
    case kBrowLeftInner:
      return kBrowRightInner;
    case kBrowLeftOuter:
      return kBrowRightOuter;
    case kNoseWingRight:
      return kNoseWingLeft;
    case kNoseWingLeft:
      return kNoseWingRight;
    case kMouthRight:
      return kMouthLeft;
    case kMouthLeft:
      return kMouthRight;
    case kContourRight:
      return kContourLeft;
    case kContourLeft:
      return kContourRight;
    case kEyeRightCentre:
      return kEyeLeftCentre;
    case kEyeLeftCentre:
      return kEyeRightCentre;
    default:
      return point;
  }
}

}  // namespace daumier::faces
