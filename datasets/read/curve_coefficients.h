#pragma once
#include "datasets/read/sketch_database.h"
#include "faces/curve_encoder.h"

#include <vector>

namespace daumier::datasets {

/// One for each point of the sketch's feature curves that it shows, 0 for the others; an empty `visible`: it shows all.
std::vector<float> PointWeights(const SketchDatabase& sketches, const std::vector<render::Stroke>& strokes,
                                const std::vector<std::vector<bool>>& visible);

/// The curve coefficients of a sketch whose strokes are the labelled curves of the template, as in training and tests
/// only. Input: all points, moved as in the sketch, and their visibility (AugmentedSketch::moved and visible; an empty
/// `visible`: all). Hidden points are ignored.
/// @throws Error if the number of points differs from that of the encoder.
faces::CurveCode GivenShape(const faces::CurveEncoder& encoder, const SketchDatabase& sketches,
                            const std::vector<render::Stroke>& strokes,
                            const std::vector<std::vector<bool>>& visible = {});

}  // namespace daumier::datasets
