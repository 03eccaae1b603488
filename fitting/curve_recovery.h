#pragma once
#include "core/options.h"
#include "faces/curve_encoder.h"
#include "fitting/projected_curves.h"
#include "render/strokes.h"

#include <span>
#include <vector>

namespace daumier::fitting {

struct CurveRecoveryOptions {
  int snaps = 2;
  double reach_px = 16;
  double max_angle = 30;

  template <class V>
  void Visit(V&& visit) {
    visit("snaps", snaps, Range{0, 20}, "How often curves are moved onto the nearest strokes and fitted again.");
    visit("reach_px", reach_px, Range{0.1, 256},
          "From how far a curve is drawn to a stroke, pixels of the canvas; halved after each snap.");
    visit("max_angle", max_angle, Range{0, 90}, "Greatest angle between a curve and the stroke it snaps to, degrees.");
  }
};

/// Fits a bilinear model of curve points to strokes without labels, from a start: every curve point moves to the
/// nearest point of a drawn stroke that runs in about its direction, with the weight (1 - (d / reach)^2)^2 of Tukey's
/// biweight and 0 beyond reach; the encoder finds u and v for these points, and its curves snap again. `start.points` +
/// constant are where the curves are at first, on the canvas; `constant` (2K, or empty for 0) is what the model leaves
/// out of its points. Once no point is within reach of a stroke, the last result (at first the start) is returned.
/// @throws Error if a number of points differs.
faces::CurveCode FollowStrokes(const faces::CurveEncoder& encoder, const CurveOffsets& offsets,
                               const faces::CurveCode& start, const std::vector<render::Stroke>& strokes,
                               const CurveRecoveryOptions& options = {}, const Eigen::VectorXf& constant = {});

/// The strokes turned, scaled and shifted as one [Umeyama 1991, in the plane], so that where curves snap to them
/// (FollowStrokes) they lie on the curves in the least-squares sense; the curves snap again `rounds` times. curves: 2K
/// coordinates on the canvas. With too few points within reach to determine a similarity the strokes stay.
/// @throws Error if a number of points differs.
std::vector<render::Stroke> PlaceOnCurves(const std::vector<render::Stroke>& strokes, const CurveOffsets& offsets,
                                          std::span<const float> curves, const CurveRecoveryOptions& options,
                                          int rounds);

/// The curve coefficients of a drawing whose strokes carry no labels: projected curves that a network predicts follow
/// the strokes (FollowStrokes), by the 2-D bilinear model of curves. predicted: 2K coordinates on the canvas. With
/// snaps = 0 the prediction itself is encoded.
/// @throws Error if a number of points differs.
faces::CurveCode RecoverCurves(const faces::CurveEncoder& encoder, const CurveOffsets& offsets,
                               std::span<const float> predicted, const std::vector<render::Stroke>& strokes,
                               const CurveRecoveryOptions& options = {});

}  // namespace daumier::fitting
