#pragma once
#include "systems/portrait/train/portrait_loss.h"
#include "systems/portrait/train/portrait_network.h"
#include "systems/portrait/train/portrait_samples.h"

namespace daumier::portrait {

/// Samples with their predicted coefficients.
struct PredictedPortraits {
  torch::Tensor coefficients;  ///< (n, 239); expression weights of kUnit in 0 .. 1.
  torch::Tensor landmarks;     ///< (n, 68, 2), pixels of the crops.
};

/// Coefficients of inputs (n, 3, R, R), at most 32 at a time, without gradients, by a network in evaluation mode.
PredictedPortraits PredictPortraits(PortraitNetwork& network, const PortraitRenderer& renderer,
                                    const torch::Tensor& inputs);

/// V x 3, cm: row i of vertices (n, V, 3).
geometry::Points VerticesOf(const torch::Tensor& vertices, int64_t i);

/// The model of a training: its identities are those of the training persons' neutral faces, or the source's own.
/// @throws Error as ModelOfFaces and ModelOfShapes, or if the source is of another topology than the database.
faces::MorphableModel ModelOfTraining(const faces::FaceDatabase& faces, const std::vector<int>& training_persons,
                                      const PortraitTrainingOptions& options);

/// Persons of the faces of a subset of a split, ascending.
std::vector<int> PersonsOf(const faces::FaceDatabase& faces, const std::vector<int>& subset);

}  // namespace daumier::portrait
