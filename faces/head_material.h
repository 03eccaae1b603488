#pragma once
#include <array>

namespace daumier::faces {

/// What a triangle of a finished head shows; teeth, gums and tongue are in rigged heads only.
enum class HeadMaterial {
  kSkin,
  kLidRim,
  kSclera,
  kLimbus,
  kIris,
  kPupil,
  kInnerLip,
  kMouth,
  kThroat,
  kTooth,
  kGum,
  kTongue
};

/// All of them with their names in files.
struct NamedHeadMaterial {
  HeadMaterial material;
  const char* name;
};
inline constexpr std::array<NamedHeadMaterial, 12> kHeadMaterials = {{{HeadMaterial::kSkin, "skin"},
                                                                      {HeadMaterial::kLidRim, "lid_rim"},
                                                                      {HeadMaterial::kSclera, "sclera"},
                                                                      {HeadMaterial::kLimbus, "limbus"},
                                                                      {HeadMaterial::kIris, "iris"},
                                                                      {HeadMaterial::kPupil, "pupil"},
                                                                      {HeadMaterial::kInnerLip, "inner_lip"},
                                                                      {HeadMaterial::kMouth, "mouth"},
                                                                      {HeadMaterial::kThroat, "throat"},
                                                                      {HeadMaterial::kTooth, "tooth"},
                                                                      {HeadMaterial::kGum, "gum"},
                                                                      {HeadMaterial::kTongue, "tongue"}}};

}  // namespace daumier::faces
