#pragma once
#include "core/options.h"
#include "faces/curve_encoder.h"
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

/// A template's curves as a list of points: curve c has the points offsets[c] .. offsets[c + 1] - 1.
using CurveOffsets = std::vector<int>;

/// The shape-level numbers of a drawing whose strokes carry no labels: starting from projected curves that a network
/// predicts, every curve point moves to the nearest point of a drawn stroke that runs in about its direction, with the
/// weight (1 - (d / reach)^2)^2 of Tukey's biweight and 0 beyond reach; the 2-D bilinear model is fitted to these
/// points (faces::CurveEncoder), and its curves snap again. predicted: 2K coordinates on the canvas. With snaps = 0 the
/// prediction itself is encoded.
/// @throws Error if a number of points differs.
faces::CurveCode RecoverCurves(const faces::CurveEncoder& encoder, const CurveOffsets& offsets,
                               std::span<const float> predicted, const std::vector<render::Stroke>& strokes,
                               const CurveRecoveryOptions& options = {});

}  // namespace daumier::fitting
