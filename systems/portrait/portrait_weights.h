#pragma once
#include "core/json.h"
#include "core/weights_folder.h"
#include "systems/portrait/portrait_run_folder.h"

#include <filesystem>

/// Shipped weights of the coarse portrait network. In addition to the network they have
///   identity.safetensors   `mean` (V, 3) F32: the mean shape less that of the face model, cm; identity modes `identity` by
///                          faces::AddScaledShapes
/// and in details `needs` and `face_model` (the weights with template and expressions) and `pictures` {crop, size}. The
/// albedo basis is computed from the template (faces::MakeAlbedoBasis).
namespace daumier::portrait {

inline constexpr const char* kIdentityFile = "identity.safetensors";

/// Largest distance of a vertex of a random face from that of the run, mm, and largest difference of a colour, 0..1.
inline constexpr double kWeightsToleranceMm = 0.25, kWeightsColourTolerance = 0.005;

/// Options from which the network is made: PortraitNetworkOptions and expression_weights.
struct PortraitNetworkOfWeights {
  PortraitNetworkOptions options;
  faces::ExpressionWeights expression_weights = faces::ExpressionWeights::kUnit;
};
Json NetworkToJson(const PortraitNetworkOfWeights& network);
/// @throws Error as ParseOptions and ExpressionWeightsNamed.
PortraitNetworkOfWeights PortraitNetworkFromJson(const Json& json);

/// Writes identity.safetensors of a run into `folder`, for weights that will lie in `neighbours`, where the face model of
/// its source is ("face-ict" of "ict").
/// @throws Error naming the command that repairs it if there is no such face model, or naming what differs if faces and
/// colours made with it are not those of the run.
WeightsParts WritePortraitWeights(const PortraitRunFolder& run, const std::filesystem::path& folder,
                                  const std::filesystem::path& neighbours);

/// Shipped weights as a run folder, for prediction; options that a prediction does not read have their defaults.
/// @throws Error as ReadWeights, NeededWeights and faces::ReadFaceModelWeights, or naming a file that is malformed.
PortraitRunFolder ReadPortraitWeights(const std::filesystem::path& directory);

/// A finished run, or shipped weights. @throws Error as ReadPortraitRunFolder and ReadPortraitWeights.
PortraitRunFolder ReadPortraitFolder(const std::filesystem::path& run_or_weights);

}  // namespace daumier::portrait
