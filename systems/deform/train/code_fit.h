#pragma once
#include "core/options.h"
#include "core/task.h"
#include "systems/deform/train/code_energy.h"

#include <Eigen/Cholesky>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace daumier::deform {

/// How the minimum of a CodeEnergy is found.
struct CodeSolveOptions {
  std::string method = "gauss_newton";
  int newton_steps = 20;
  int num_rows = 400;
  int adam_steps = 1000;
  double learning_rate = 1e-4;
  uint64_t seed = 1;

  template <class V>
  void Visit(V&& visit) {
    visit("method", method, Choices{{"gauss_newton", "adam"}},
          "How a code is found: by our second-order solve, or by Adam as in the paper.");
    visit("newton_steps", newton_steps, Range{1, 1000}, "Steps of gauss_newton at most.");
    visit("num_rows", num_rows, Range{1, 1e7},
          "Points of a whole surface that gauss_newton takes derivatives of in a step.");
    visit("adam_steps", adam_steps, Range{1, 1e6}, "Steps of adam.");
    visit("learning_rate", learning_rate, Range{1e-8, 1}, "Of adam.");
    visit("seed", seed, Range{0, 9e15}, "Of the points that gauss_newton takes derivatives of.");
  }
};

/// A fit to all points of a surface, with a prior of mean 0.
struct CodeFitOptions {
  double data_weight = 3e3;  ///< Of the mean squared coordinate, in model units.
  double code_weight = 1e6;  ///< Of the code's mean square.
  CodeSolveOptions solve;    ///< How the code is found.
};

struct CodeFit {
  torch::Tensor code;      ///< (M), of the type and on the device of the template.
  double energy = 0;       ///< E of the code.
  double mean_square = 0;  ///< Of the all-points term without its weight: mean over the 3N coordinates of squared
                           ///< distance; 0 without that term.
  int steps = 0;           ///< Of gauss_newton those that were taken, of adam all.
  int num_matrices = 0;    ///< Normal matrices that gauss_newton computed, each from derivatives by all M numbers.
  double seconds = 0;      ///< By the clock.
  std::vector<double> energies;  ///< E at the start and after each step.
};

/// The code of least energy E(z), with the network held fixed, from `start` (M), or from 0.
/// adam: one step is the energy over all points, betas 0.9 and 0.999. The code of least energy is kept; the authors'
/// program keeps the last.
/// gauss_newton: damped steps with the exact gradient and the matrix of CodeObjective::HalfHessian of num_rows points,
/// other ones in each step. A step that does not lower the energy is not taken, so that energies never rise; ends where
/// the energy falls by less than 1e-5 of itself. A linear model with num_rows of at least N is solved in one step.
/// Equal options give equal codes. `task` is cancelled between steps; adam reports its steps.
/// @throws Error as CodeObjective; if start has another shape or a number that is not finite; if the energy of the
/// start, or a derivative of a position by the code, is not finite; Cancelled if the task is.
CodeFit FitCode(DeformNetwork& network, CodeEnergy energy, const CodeSolveOptions& options = {},
                const std::optional<torch::Tensor>& start = std::nullopt, const Task& task = {});

/// The code of a face that the network was not trained on [Jung et al. 2022, eq. 1]:
///   E(z) = data_weight / 3N sum_i |D(z, p_i) - g_i|^2 + code_weight / M |z|^2
/// from z = 0, over N points p_i of which `targets` (N, 3) are the positions g_i on the face, model units.
CodeFit FitCode(DeformNetwork& network, const SurfacePoints& points, const torch::Tensor& targets,
                const CodeFitOptions& options = {}, const Task& task = {});
/// The same over all vertices, (V, 3) model units.
CodeFit FitCode(DeformNetwork& network, const torch::Tensor& vertices, const CodeFitOptions& options = {},
                const Task& task = {});

/// Fits one energy again and again while the targets of its sparse terms move, as handles in an editor. Each Solve
/// starts at the code of the last one. gauss_newton keeps the last factorised normal matrix, which does not depend on
/// targets, and computes another only where a step with the kept one lowers the energy by less than half of what that
/// matrix predicts. The first Solve is FitCode.
class CodeFitter {
 public:
  /// The network has to outlive it. @throws Error as FitCode.
  CodeFitter(DeformNetwork& network, CodeEnergy energy, const CodeSolveOptions& options = {},
             const std::optional<torch::Tensor>& start = std::nullopt);

  /// Other targets (P, 3) of a term of energy.sparse_points. @throws Error as CodeObjective::MoveTargets.
  void MoveTargets(size_t sparse_term, const torch::Tensor& targets) { objective_.MoveTargets(sparse_term, targets); }
  /// energies and counts are those of this solve. @throws Error as FitCode.
  CodeFit Solve(const Task& task = {});

  /// (M), where the next Solve starts.
  const torch::Tensor& code() const { return code_; }
  const CodeEnergy& energy() const { return objective_.energy(); }

 private:
  CodeFit SolveByGaussNewton(const Task& task);
  CodeFit SolveByAdam(const Task& task);
  /// Steps with the kept matrix; whether they ended at a minimum.
  bool StepWithKeptMatrix(CodeFit& fit, CodeEnergyValue& here);

  CodeObjective objective_;
  CodeSolveOptions options_;
  torch::Tensor code_;
  std::optional<Eigen::LDLT<Eigen::MatrixXd>> kept_;
};

}  // namespace daumier::deform
