#pragma once
#include "core/json.h"
#include "core/weights_folder.h"
#include "systems/sketch/run_folder.h"

#include <filesystem>

/// Shipped weights of a sketch network whose basis is that of the Gaussian of faces (SketchNetworkOptions::basis). The
/// basis is in network.safetensors; details of the manifest hold
///   network     SketchNetworkOptions and SketchNetworkSizes
///   sketches    {camera, feature_curves}, as in a run
///   gaussian    {mean, deviation, num_symmetric}: faces::GaussianOfBasis
///   face_model  the weights with the template, also in `needs`
/// They have no bilinear model: contours of sketches in the training's own frame are not matched.
namespace daumier::sketch {

/// From these a network is made, without its numbers.
struct SketchNetworkOfWeights {
  SketchNetworkOptions options;
  SketchNetworkSizes sizes;
};
Json NetworkToJson(const SketchNetworkOfWeights& network);
/// @throws Error as ParseOptions, or if a table is missing.
SketchNetworkOfWeights SketchNetworkFromJson(const Json& json);

/// `details` of weights that will lie in `neighbours`, where the face model of the run's source is ("face-ict" of "ict").
/// @throws Error if the network reads curve coefficients or has another basis, or naming the command that repairs it if
/// there is no such face model, or if it is another template.
WeightsParts WriteSketchWeights(const SketchRunFolder& run, const std::filesystem::path& neighbours);

/// Shipped weights as a run folder, for prediction: without bilinear and curve models.
/// @throws Error as ReadWeights, NeededWeights and faces::ReadFaceModelWeights, or naming a file that is malformed.
SketchRunFolder ReadSketchWeights(const std::filesystem::path& directory);

/// A finished run, or shipped weights. @throws Error as ReadSketchRunFolder and ReadSketchWeights.
SketchRunFolder ReadSketchFolder(const std::filesystem::path& run_or_weights);

}  // namespace daumier::sketch
