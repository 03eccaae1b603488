#pragma once
#include "core/options.h"
#include "faces/bilinear_model.h"
#include "faces/coefficient_prior.h"
#include "faces/curve_encoder.h"
#include "fitting/curve_recovery.h"
#include "fitting/projected_curves.h"

#include <vector>

namespace daumier::fitting {

struct ContourRefinementOptions {
  double trust = 0.125;
  int placement_rounds = 3;
  faces::CurveEncoderOptions encoder{.deviation_px = 1.0, .rounds = 4};
  CurveRecoveryOptions snapping{.snaps = 1, .reach_px = 12};

  template <class V>
  void Visit(V&& visit) {
    visit("trust", trust, Range{1e-3, 100},
          "Deviation of u and v from the prediction, as a share of theirs over the training faces.");
    visit("placement_rounds", placement_rounds, Range{0, 20},
          "How often the drawing is first turned, scaled and shifted onto the predicted curves; 0: it is where it is.");
    visit("encoder", encoder, Table{}, "How curve points are fitted.");
    visit("snapping", snapping, Table{}, "How curves are drawn to strokes.");
  }
};

/// What a network makes of a sketch.
struct PredictedFace {
  Eigen::VectorXf u, v;
  std::vector<float> vertices;  ///< 3V, cm.
};

/// Contour matching after a network: the drawing is placed on the feature curves of the predicted face, as the camera
/// projects them (PlaceOnCurves), since drawings are not in a camera's frame; the curves snap to its strokes, which
/// have no labels (FollowStrokes), and u and v are fitted to them with a normal prior about the network's own
/// prediction. The predicted face may differ from the bilinear model by a residual, which is unchanged:
///   face(u', v') = predicted face + C x2 u' x3 v' - C x2 u x3 v.
/// Where no stroke is within reach, the prediction is returned unchanged.
class ContourRefiner {
 public:
  /// Keeps a reference to the model. @throws Error as ProjectModel.
  ContourRefiner(const faces::BilinearModel& model, const ProjectedCurves& curves,
                 const ContourRefinementOptions& options = {});

  /// strokes: on the canvas. @throws Error if a number of coordinates or coefficients differs.
  PredictedFace Refine(const PredictedFace& face, const std::vector<render::Stroke>& strokes) const;

  const ProjectedCurves& curves() const { return curves_; }

 private:
  const faces::BilinearModel* model_;
  ProjectedCurves curves_;
  ProjectedModel projected_;
  faces::CoefficientPrior prior_;
  ContourRefinementOptions options_;
};

}  // namespace daumier::fitting
