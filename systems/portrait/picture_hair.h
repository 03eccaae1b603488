#pragma once
#include "faces/appearance/looks.h"
#include "render/image.h"

#include <span>

namespace daumier::portrait {

/// Hair as a picture shows it, in a frame of the face: v upwards along the line from the chin to the middle between the
/// brows, u across it, both in units of that line; v = 0 at the brows, -1 at the chin.
struct ShownHair {
  double crown = 0;     ///< Share of 0.3 < v < 0.7, |u| < 0.4 that is hair.
  double forehead = 1;  ///< The lowest v of hair above the brows at |u| < 0.2: small for a fringe.
  double length = 0;    ///< The lowest v of hair on both sides of the face (0.5 < |u| < 1.1).
  Eigen::Vector3f colour = {0.25F, 0.16F, 0.1F};  ///< Median of hair above the brows, RGB in 0 .. 1.
};

/// mask: PictureClass of each pixel; landmarks: 68 x 2, pixels. What lies outside of the picture counts as no hair.
/// @throws Error unless there are 68 landmarks, and a mask of the picture's size.
ShownHair FindShownHair(const render::Image& picture, const render::Image& mask, std::span<const float> landmarks);

/// The hair of a portrait's head that is most alike: bald where the crown has less than 0.15 of hair; long hair below
/// v = -1.15 on a side, a bob below -0.65, else short, with a fringe where hair covers the forehead (forehead < 0.13).
faces::Looks LooksOf(const ShownHair& hair);

}  // namespace daumier::portrait
