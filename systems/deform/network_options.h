#pragma once
#include "core/options.h"
#include "runtime/siren_kernel.h"

#include <string>

namespace daumier::deform {

/// Which deformable model [Jung et al. 2022, sections 3.2 and 4.2].
struct DeformOptions {
  std::string kind = "hypernetwork";
  int latent = 128;
  int width = 128;
  int hidden_layers = 3;
  double omega = 30;
  int hyper_width = 256;
  int array_width = 400;

  template <class V>
  void Visit(V&& visit) {
    visit("kind", kind, Choices{{"hypernetwork", "conditioning", "displacements", "positions", "linear"}},
          "How a code becomes a surface. hypernetwork: a SIREN whose parameters a hypernetwork makes; conditioning: a "
          "SIREN that reads the code; displacements, positions: an array of vertex displacements or positions; linear: "
          "principal components.");
    visit("latent", latent, Range{1, 4096}, "Length of a code.");
    visit("width", width, Range{16, 1024}, "Features in a layer of the SIREN; a multiple of 16.");
    visit("hidden_layers", hidden_layers, Range{1, 16}, "Layers of the SIREN between its first and its last.");
    visit("omega", omega, Range{0.1, 1000}, "Frequency of the SIREN's sines.");
    visit("hyper_width", hyper_width, Range{1, 4096}, "Neurons in a layer of the hypernetwork.");
    visit("array_width", array_width, Range{1, 16384}, "Neurons in the hidden layer of displacements and positions.");
  }

  runtime::SirenLayout siren() const { return {width, hidden_layers, omega}; }
  /// Whether it predicts vertices alone, and points between them by interpolation.
  bool is_array() const { return kind == "displacements" || kind == "positions" || kind == "linear"; }
};

}  // namespace daumier::deform
