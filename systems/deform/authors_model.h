#pragma once
#include "core/array.h"
#include "systems/deform/network_options.h"

#include <filesystem>
#include <string>
#include <vector>

namespace daumier::deform {

/// The network of [Jung et al. 2022] as the authors' program stores it, under the names that our runs use.
struct AuthorsModel {
  DeformOptions options;  ///< Kind "hypernetwork".
  /// codes (faces, M) and network.{weights,biases}_LAYER.{first,second,last}.{weight,bias}; no template and no frame.
  NamedArrays arrays;
  std::vector<std::string> unused;  ///< Tensors that the authors' program stores but does not use.
};

/// Tensors by the names of the authors' program, of L layers from 3 to 3 coordinates:
///   latent_codes.weight (faces, M)                      the codes of the training faces
///   hyper_net.nets.{2l, 2l+1}.net.{0,1,2}.0.{weight,bias}  the networks that make the weights (outputs x inputs, row by
///                                                          row) and the biases of layer l
///   deform_net.net.net.l.0.{weight,bias}                the SIREN's own parameters, which are never used; may be absent
/// The frequency 30 of the sines is a constant of that program. Sizes are those of the tensors: 128, 128, 256 and 5
/// layers in the paper, with 71 tensors. `file` names their file in messages.
/// @throws Error naming file, tensor, expected and found shape: a missing, another or a mis-shaped tensor, or a number
/// that is not finite.
AuthorsModel AuthorsModelOf(const NamedArrays& tensors, const std::string& file);

/// The tensors of a file: of torch.save (faces::ReadTorchState), or of safetensors with elements of float32 or float16.
/// @throws Error as these readers.
NamedArrays ReadStateFile(const std::filesystem::path& path);

}  // namespace daumier::deform
