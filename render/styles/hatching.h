#pragma once
#include "core/random.h"
#include "render/styles/colour_planes.h"

namespace daumier::render {

struct HatchStyle {
  float spacing = 4;     ///< Pixels between lines.
  float angle = 0.6f;    ///< Of the first layer's lines to the x axis, radians.
  float softness = 0;    ///< 0: pen, edges of one pixel; 1: pencil, lines fade into each other.
  float wobble = 0.25f;  ///< Deviation of lines, share of the spacing.
};

/// Tone by layers of parallel lines [Winkenbach & Salesin 1994]: coverage in 0..1 for a darkness in 0..1. No line where
/// the darkness is below 0.08; a first layer of lines that grow wider, from 0.4 a second across it, from 0.65 a third.
/// Lines wave a little and their pressure changes along them.
Plane Hatch(const Plane& darkness, const HatchStyle& style, Rng& rng);

}  // namespace daumier::render
