#include "fitting/contour_refinement.h"

#include "core/error.h"

namespace daumier::fitting {

ContourRefiner::ContourRefiner(const faces::BilinearModel& model, const ProjectedCurves& curves,
                               const ContourRefinementOptions& options)
    : model_(&model),
      curves_(curves),
      projected_(ProjectModel(curves, model)),
      prior_(faces::PriorOf(model)),
      options_(options) {}

PredictedFace ContourRefiner::Refine(const PredictedFace& face, const std::vector<render::Stroke>& strokes) const {
  const auto& [u, v, vertices] = face;
  DAUMIER_CHECK(int(vertices.size()) == model_->num_coordinates(), "a face of {} coordinates for a model of {}",
                vertices.size(), model_->num_coordinates());
  const faces::CurveEncoder encoder(projected_.model, faces::CentredPrior(prior_, u, v, options_.trust),
                                    options_.encoder);
  const faces::CurveCode start{.u = u, .v = v, .points = faces::Reconstruct(projected_.model, u, v)};
  const std::vector<float> predicted = Project(curves_, vertices);
  const Eigen::VectorXf constant =
      Eigen::Map<const Eigen::VectorXf>(predicted.data(), Eigen::Index(predicted.size())) - start.points;
  const auto placed = PlaceOnCurves(strokes, curves_.offsets, predicted, options_.snapping, options_.placement_rounds);
  const faces::CurveCode code = FollowStrokes(encoder, curves_.offsets, start, placed, options_.snapping, constant);

  if (code.u == u && code.v == v) return face;
  PredictedFace refined{.u = code.u, .v = code.v, .vertices = vertices};
  Eigen::Map<Eigen::VectorXf>(refined.vertices.data(), Eigen::Index(vertices.size())) +=
      faces::Reconstruct(*model_, code.u, code.v) - faces::Reconstruct(*model_, u, v);
  return refined;
}

}  // namespace daumier::fitting
