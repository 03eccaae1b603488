#pragma once
#include "fitting/projected_curves.h"
#include "fitting/stroke_segments.h"

#include <Eigen/Core>

#include <vector>

namespace daumier::fitting {

/// Where curve points are drawn to, and how strongly.
struct CurvePull {
  std::vector<float> points;   ///< 2K, on the canvas.
  std::vector<float> weights;  ///< K; 0: nothing is within reach.

  bool any() const;
};

/// Every curve point is drawn to the nearest point of a stroke that runs in about its curve's direction (its cosine is
/// at least `least_cosine`), with the weight (1 - (d / reach)^2)^2 of Tukey's biweight and 0 beyond reach, where it
/// stays. curves: 2K coordinates on the canvas. reach: at most the grid's.
CurvePull PullOf(const SegmentGrid& strokes, const CurveOffsets& offsets, const Eigen::VectorXf& curves, float reach,
                 float least_cosine);

}  // namespace daumier::fitting
