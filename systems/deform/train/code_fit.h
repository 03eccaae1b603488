#pragma once
#include "core/options.h"
#include "systems/deform/train/network.h"

#include <torch/types.h>

#include <cstdint>
#include <string>
#include <vector>

namespace daumier::deform {

struct CodeFitOptions {
  std::string method = "gauss_newton";
  double data_weight = 3e3;
  double code_weight = 1e6;
  int newton_steps = 20;
  int num_rows = 400;
  int adam_steps = 1000;
  double learning_rate = 1e-4;
  uint64_t seed = 1;

  template <class V>
  void Visit(V&& visit) {
    visit("method", method, Choices{{"gauss_newton", "adam"}},
          "How a code is found: by our second-order solve, or by Adam as in the paper.");
    visit("data_weight", data_weight, Range{1e-6, 1e12}, "Weight of the mean squared coordinate, in model units.");
    visit("code_weight", code_weight, Range{0, 1e12}, "Weight of the code's mean square.");
    visit("newton_steps", newton_steps, Range{1, 1000}, "Steps of gauss_newton at most.");
    visit("num_rows", num_rows, Range{1, 1e7}, "Points that gauss_newton takes derivatives of in a step.");
    visit("adam_steps", adam_steps, Range{1, 1e6}, "Steps of adam.");
    visit("learning_rate", learning_rate, Range{1e-8, 1}, "Of adam.");
    visit("seed", seed, Range{0, 9e15}, "Of the points that gauss_newton takes derivatives of.");
  }
};

struct CodeFit {
  torch::Tensor code;      ///< (M) float32, where the points are.
  double energy = 0;       ///< E of the code.
  double mean_square = 0;  ///< Its data term without the weight: mean over the 3N coordinates of squared distance.
  int steps = 0;           ///< Of gauss_newton those that were taken, of adam all.
  double seconds = 0;      ///< By the clock.
  std::vector<double> energies;  ///< E at zero and after each step.
};

/// The code of a face that the network was not trained on, with the network held fixed [Jung et al. 2022, eq. 1]:
///   E(z) = data_weight / 3N sum_i |D(z, p_i) - g_i|^2 + code_weight / M |z|^2
/// from z = 0, over N points p_i that stand at `targets` (N, 3) on the face, model units. The mean is over coordinates,
/// as in the authors' program; the printed sum is three times that.
/// adam: one step is the energy over all points, betas 0.9 and 0.999. The code of least energy is kept; the authors'
/// program keeps the last.
/// gauss_newton: damped steps with the exact gradient over all points and the matrix J^T J of num_rows of them, other
/// ones in each step, J by forward differences of the code. A step that does not lower the energy is not taken, so
/// that energies never rise; ends where the energy falls by less than 1e-5 of itself. A linear model with num_rows of
/// at least N is solved in one step.
/// Equal options give equal codes. @throws Error if a shape disagrees or there is no point.
CodeFit FitCode(DeformNetwork& network, const SurfacePoints& points, const torch::Tensor& targets,
                const CodeFitOptions& options = {});
/// The same over all vertices, (V, 3) model units.
CodeFit FitCode(DeformNetwork& network, const torch::Tensor& vertices, const CodeFitOptions& options = {});

}  // namespace daumier::deform
