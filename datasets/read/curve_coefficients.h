#pragma once
#include "datasets/read/sketch_database.h"
#include "faces/curve_encoder.h"

#include <vector>

namespace daumier::datasets {

/// One for each point of the sketch's feature curves that it shows, 0 for the others; an empty `visible`: it shows all.
std::vector<float> PointWeights(const SketchDatabase& sketches, const std::vector<render::Stroke>& strokes,
                                const std::vector<std::vector<bool>>& visible);

/// The shape-level numbers of a sketch whose strokes are known to be the template's curves, as in training and in a
/// test alone: all points that came in, where the sketch has them, and whether it shows them (AugmentedSketch::moved
/// and visible; an empty `visible`: all). Points that it does not show are not looked at.
/// @throws Error if the number of points differs from that of the encoder.
faces::CurveCode GivenShape(const faces::CurveEncoder& encoder, const SketchDatabase& sketches,
                            const std::vector<render::Stroke>& strokes,
                            const std::vector<std::vector<bool>>& visible = {});

}  // namespace daumier::datasets
