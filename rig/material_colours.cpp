#include "rig/material_colours.h"

namespace daumier::rig {

Eigen::Vector3f MaterialColour(faces::HeadMaterial material) {
  using enum faces::HeadMaterial;
  switch (material) {
    case kSkin:
      return {0.84f, 0.66f, 0.565f};
    case kLidRim:
      return {0.77f, 0.55f, 0.48f};
    case kSclera:
      return {0.925f, 0.91f, 0.885f};
    case kLimbus:
      return {0.23f, 0.18f, 0.16f};
    case kIris:
      return {0.375f, 0.47f, 0.54f};
    case kPupil:
      return {0.06f, 0.055f, 0.055f};
    case kInnerLip:
      return {0.675f, 0.36f, 0.345f};
    case kMouth:
      return {0.42f, 0.16f, 0.16f};
    case kThroat:
      return {0.18f, 0.06f, 0.07f};
    case kTooth:
      return {0.93f, 0.91f, 0.85f};
    case kGum:
      return {0.70f, 0.38f, 0.37f};
    case kTongue:
      return {0.72f, 0.37f, 0.36f};
  }
  return Eigen::Vector3f::Zero();
}

}  // namespace daumier::rig
