#include "systems/portrait/train/portrait_loss.h"

#include "losses/coefficient_loss.h"
#include "losses/coefficient_prior_loss.h"
#include "losses/landmark_loss.h"
#include "losses/opening_loss.h"
#include "losses/photometric_loss.h"
#include "losses/reflectance_loss.h"
#include "models/coefficient_map.h"

#include <torch/types.h>

#include <array>

namespace daumier::portrait {
namespace {

using models::Slot;

/// Of vertices that are not in the face region, where errors are measured.
constexpr double kOutsideWeight = 0.2;

torch::Tensor RegionWeights(const faces::MorphableModel& model, double outside, bool skin_alone,
                            torch::ScalarType type) {
  const faces::Annotation& annotation = model.face_template.annotation;
  std::vector<double> weights(size_t(model.face_template.num_vertices()), outside);
  for (const int vertex : faces::RegionFor(annotation, "face", "portraits")) weights[size_t(vertex)] = 1;
  if (skin_alone) {
    for (const char* region : {"eyes", "mouth"}) {
      const auto found = annotation.regions.find(region);
      if (found == annotation.regions.end()) continue;
      for (const int vertex : found->second) weights[size_t(vertex)] = 0;
    }
  }
  return torch::tensor(weights, torch::kFloat64).to(type);
}

/// Expression, albedo and light: the mean square of an unknown one times its weight is about 1 for each group.
torch::Tensor SupervisionWeights(torch::ScalarType type) {
  constexpr double kExpression = 1, kAlbedo = 0.0125, kLight = 2;
  return torch::cat({torch::full({faces::kExpressionSlot.count}, kExpression, type),
                     torch::full({faces::kAlbedoSlot.count}, kAlbedo, type),
                     torch::full({faces::kLightSlot.count}, kLight, type)});
}

models::SharedTopology TopologyOf(const faces::MorphableModel& model) {
  const geometry::Triangles& triangles = model.face_template.triangles;
  return std::make_shared<const raster::MeshTopology>(
      raster::MakeTopology({triangles.data(), size_t(triangles.size())}, model.face_template.num_vertices()));
}

}  // namespace

PortraitRenderer::PortraitRenderer(const faces::MorphableModel& model, torch::ScalarType type)
    : layer_(model, type), topology_(TopologyOf(model)) {}

torch::Tensor PortraitRenderer::Landmarks(const torch::Tensor& coefficients) const {
  return models::PointsInPicture(layer_.Landmarks(coefficients), Slot(coefficients, faces::kPoseSlot));
}

models::RenderedPictures PortraitRenderer::Render(const torch::Tensor& coefficients, const torch::Tensor& vertices,
                                                  const torch::Tensor& albedo, bool antialias) const {
  raster::PictureOptions settings;
  // A silhouette is never farther in front of its surroundings than this: no crossing counts.
  if (!antialias) settings.antialias.least_gap = 1e30;
  return models::RenderFace(topology_, vertices, albedo, Slot(coefficients, faces::kLightSlot).contiguous(),
                            Slot(coefficients, faces::kPoseSlot).contiguous(), {}, settings);
}

PortraitLoss::PortraitLoss(const faces::MorphableModel& model, const PortraitLossOptions& options,
                           torch::ScalarType type)
    : options_(options),
      renderer_(model, type),
      skin_weights_(RegionWeights(model, 0, true, type)),
      vertex_weights_(RegionWeights(model, kOutsideWeight, false, type)),
      coefficient_weights_(SupervisionWeights(type)),
      angle_weights_(torch::ones({3}, type)) {}

train::LossTerms PortraitLoss::operator()(const torch::Tensor& coefficients, const train::Batch& batch) const {
  train::LossTerms terms{torch::zeros({}, coefficients.options()), {}};
  const auto add = [&](const char* name, double weight, const torch::Tensor& term) {
    terms.total = terms.total + weight * term;
    terms.parts[name] = term;
  };
  const torch::Tensor landmarks = renderer_.Landmarks(coefficients);
  if (options_.landmarks > 0)
    add("landmark_loss", options_.landmarks,
        losses::LandmarkLoss(landmarks, batch.at("landmarks"), batch.at("landmark_weights")));
  if (options_.openings > 0) {
    const torch::Tensor& target = batch.at("landmarks");
    add("opening_loss", options_.openings,
        losses::OpeningLoss(landmarks, target, losses::EyelidPairs()) +
            0.5 * losses::OpeningLoss(landmarks, target, losses::LipPairs()));
  }
  if (options_.regulariser > 0)
    add("regulariser", options_.regulariser,
        losses::CoefficientPriorLoss(Slot(coefficients, faces::kIdentitySlot),
                                     Slot(coefficients, faces::kExpressionSlot), Slot(coefficients, faces::kAlbedoSlot),
                                     {options_.identity, options_.expression, options_.albedo}));
  const bool with_vertices = options_.renders() || options_.reads_vertices();
  const torch::Tensor vertices = with_vertices ? renderer_.layer().Vertices(coefficients) : torch::Tensor();
  if (options_.renders() || options_.reflectance > 0) {
    const torch::Tensor albedo = renderer_.layer().Albedo(coefficients);
    if (options_.reflectance > 0)
      add("reflectance_loss", options_.reflectance, losses::ReflectanceLoss(albedo, skin_weights_));
    if (options_.renders()) {
      const models::RenderedPictures rendered = renderer_.Render(coefficients, vertices, albedo, options_.antialias);
      // Silhouettes mix the face with the black around it: pixels that are wholly covered count.
      constexpr double kCovered = 0.999;
      const torch::Tensor mask = batch.at("skin") * (rendered.masks.detach() > kCovered).to(coefficients.scalar_type());
      add("photometric_loss", options_.photometric,
          losses::PhotometricLoss(
              rendered.pictures, batch.at("picture"), mask,
              options_.colours == "squared" ? losses::ColourDistance::kSquared : losses::ColourDistance::kLength));
    }
  }
  if (options_.vertices > 0)
    add("vertex_loss", options_.vertices,
        losses::KnownVertexLoss(vertices, batch.at("vertices"), vertex_weights_, batch.at("known")));
  if (options_.coefficients > 0)
    add("coefficient_loss", options_.coefficients,
        losses::CoefficientLoss(coefficients.narrow(1, faces::kExpressionSlot.first, coefficient_weights_.size(0)),
                                torch::cat({batch.at("expression"), batch.at("albedo"), batch.at("light")}, 1),
                                coefficient_weights_, batch.at("known")));
  if (options_.angles > 0)
    add("angle_loss", options_.angles,
        losses::CoefficientLoss(Slot(coefficients, faces::kPoseSlot).narrow(1, 0, 3), batch.at("angles"),
                                angle_weights_, batch.at("known")));
  return terms;
}

}  // namespace daumier::portrait
