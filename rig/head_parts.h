#pragma once
#include "rig/head_surface.h"
#include "rig/template_match.h"

#include <array>
#include <optional>
#include <vector>

namespace daumier::rig {

/// What a connected part of a head is.
enum class HeadPart : uint8_t {
  kSkin,      ///< Most of it lies on the template.
  kRightEye,  ///< A ball behind the lids, and what lies on it.
  kLeftEye,
  kUpperMouth,  ///< Teeth and gums that stay with the skull.
  kLowerMouth,  ///< Teeth, gums and tongue that move with the jaw.
  kWholeMouth,  ///< Gums of both jaws: what is above stays, what is below moves with the jaw, and what is between partly.
  kFlatEye,     ///< Lies between lids and is no ball: it stays.
  kAttached     ///< Lashes, hair, glasses: follows the nearest skin.
};

/// A ball, cm.
struct Ball {
  geometry::Vector3 centre;
  double radius;
};

/// The sphere that fits points best by algebraic least squares; nothing if they are fewer than 12, lie in one plane, or
/// are off it by more than 5 % of its radius in the root mean square. points: N x 3.
std::optional<Ball> FitBall(const geometry::Points& points);

struct HeadParts {
  std::vector<HeadPart> of_components;
  std::vector<float> jaw_shares = {};       ///< P: how much of the jaw's motion a place in the mouth has; 0 elsewhere.
  std::array<std::optional<Ball>, 2> eyes;  ///< The right one and the left one; both or none.
  HeadPart of_place(const HeadSurface& head, int place) const {
    return of_components[size_t(head.components[size_t(place)])];
  }
};

/// Sorts the connected parts of a head, on which the template is registered. head: in the frame of the template.
/// eyes: the balls of the template, the right one first: a ball of the head has a centre within 0.8 and a radius within
/// 0.5 to 1.8 of the radius of one of them.
/// Parts in the mouth lie behind the lips, within 0.7 of the mouth's width. A part that reaches farther than 0.2 of that
/// width above and below the line of the lips belongs to both jaws if it is as wide as the mouth, and to the lower one, as a
/// tongue does, if it is not; the others are upper or lower by the largest gap between the heights of their middles.
/// @throws Error if no part is skin.
HeadParts FindHeadParts(const TemplateMatch& match, const HeadSurface& head, const std::array<Ball, 2>& eyes);

}  // namespace daumier::rig
