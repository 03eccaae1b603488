#include "systems/deform/train/code_fit.h"

#include "core/error.h"
#include "core/random.h"
#include "core/stopwatch.h"
#include "tensor/eigen.h"
#include "tensor/shape.h"

#include <torch/optim/adam.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace daumier::deform {
namespace {

/// Damping as a share of the matrix' mean diagonal: where it begins, from where it is raised, by which factor, and how
/// often in one step.
constexpr double kLeastDamping = 1e-9, kFirstDamping = 1e-2, kDampingFactor = 10;
constexpr int kMostTrials = 8;
/// A fit ends at a step that lowers the energy by less than this share.
constexpr double kLeastFall = 1e-5;
/// A kept matrix is replaced where the energy falls by less than this share of what it predicts.
constexpr double kLeastGain = 0.5;

using Factor = Eigen::LDLT<Eigen::MatrixXd>;

/// `count` different numbers of 0 .. num_points - 1, ascending.
torch::Tensor DrawRows(int64_t num_points, int64_t count, Rng& rng, torch::Device device) {
  std::vector<int64_t> indices(static_cast<size_t>(num_points));
  std::iota(indices.begin(), indices.end(), int64_t(0));
  const size_t num_rows = size_t(std::min(count, num_points));
  for (size_t i = 0; i < num_rows; ++i) std::swap(indices[i], indices[i + rng.Below(indices.size() - i)]);
  std::sort(indices.begin(), indices.begin() + std::ptrdiff_t(num_rows));
  return torch::tensor(at::ArrayRef<int64_t>(indices.data(), num_rows)).to(device);
}

Eigen::VectorXd HalfGradient(const CodeEnergyValue& value) {
  return tensor::CopyToMatrix<double>(value.gradient.unsqueeze(1)) / 2;
}

/// damping: as a share of the mean diagonal.
Factor Factorised(const Eigen::MatrixXd& hessian, double damping) {
  Eigen::MatrixXd damped = hessian;
  damped.diagonal().array() += damping * hessian.diagonal().mean();
  return damped.ldlt();
}

/// The minimum of the quadratic model, as a step; absent if the factorisation failed or its numbers overflow.
std::optional<Eigen::VectorXd> Step(const Factor& factor, const Eigen::VectorXd& half_gradient) {
  if (factor.info() != Eigen::Success) return std::nullopt;
  Eigen::VectorXd step = factor.solve(-half_gradient);
  if (!step.allFinite()) return std::nullopt;
  return step;
}

torch::Tensor Moved(const torch::Tensor& code, const Eigen::VectorXd& step) {
  return code + tensor::CopyToTensor(step).to(code.options());
}

CodeEnergyValue AtStart(const CodeObjective& objective, const torch::Tensor& code) {
  CodeEnergyValue value = objective.At(code);
  DAUMIER_CHECK(std::isfinite(value.energy),
                "the energy of the code where a fit starts is not finite (found {}): see the network's weights",
                value.energy);
  return value;
}

}  // namespace

CodeFitter::CodeFitter(DeformNetwork& network, CodeEnergy energy, const CodeSolveOptions& options,
                       const std::optional<torch::Tensor>& start)
    : objective_(network, std::move(energy)), options_(options), code_(objective_.Zero()) {
  if (!start) return;
  tensor::CheckShape(*start, code_.sizes(), "start");
  DAUMIER_CHECK(torch::isfinite(*start).all().item<bool>(), "start has numbers that are not finite");
  code_ = start->detach().to(code_.options()).clone();
}

CodeFit CodeFitter::Solve(const Task& task) {
  const Stopwatch stopwatch;
  CodeFit fit = options_.method == "adam" ? SolveByAdam(task) : SolveByGaussNewton(task);
  code_ = fit.code.clone();
  fit.seconds = stopwatch.seconds();
  return fit;
}

bool CodeFitter::StepWithKeptMatrix(CodeFit& fit, CodeEnergyValue& here) {
  while (kept_ && fit.steps < options_.newton_steps) {
    const Eigen::VectorXd half_gradient = HalfGradient(here);
    const std::optional<Eigen::VectorXd> step = Step(*kept_, half_gradient);
    if (!step) return false;
    const double predicted = -half_gradient.dot(*step), before = here.energy;
    const torch::Tensor code = Moved(fit.code, *step);
    CodeEnergyValue there = objective_.At(code);
    if (!(there.energy < before)) return predicted < kLeastFall * before;
    here = std::move(there);
    fit.code = code;
    fit.energies.push_back(here.energy);
    ++fit.steps;
    const double fall = before - here.energy;
    if (fall < kLeastGain * predicted) return false;
    if (fall < kLeastFall * before) return true;
  }
  return false;
}

CodeFit CodeFitter::SolveByGaussNewton(const Task& task) {
  CodeFit fit;
  fit.code = code_;
  CodeEnergyValue here = AtStart(objective_, fit.code);
  fit.energies = {here.energy};
  double damping = kLeastDamping;

  /// The first step of growing damping that lowers the energy.
  const auto lower = [&](const Eigen::MatrixXd& hessian) -> std::optional<torch::Tensor> {
    const Eigen::VectorXd half_gradient = HalfGradient(here);
    for (int trial = 0; trial < kMostTrials; ++trial) {
      if (const std::optional<Eigen::VectorXd> step = Step(Factorised(hessian, damping), half_gradient)) {
        const torch::Tensor code = Moved(fit.code, *step);
        CodeEnergyValue there = objective_.At(code);
        if (there.energy < here.energy) {
          here = std::move(there);
          return code;
        }
      }
      damping = std::max(kFirstDamping, kDampingFactor * damping);
    }
    return std::nullopt;
  };

  bool ended = StepWithKeptMatrix(fit, here);
  while (!ended && fit.steps < options_.newton_steps) {
    task.ThrowIfCancelled("the fit of a code was stopped after {} steps", fit.steps);
    Rng rng = Stream(options_.seed, "rows of a code fit", uint64_t(fit.num_matrices));
    const torch::Tensor rows = DrawRows(objective_.num_points(), options_.num_rows, rng, fit.code.device());
    const Eigen::MatrixXd hessian = objective_.HalfHessian(fit.code, rows);
    DAUMIER_CHECK(hessian.allFinite(), "derivatives of positions by the code are not finite after {} steps", fit.steps);
    ++fit.num_matrices;
    kept_ = Factorised(hessian, kLeastDamping);
    const std::optional<torch::Tensor> code = lower(hessian);
    if (!code) break;
    const double before = fit.energies.back();
    fit.code = *code;
    fit.energies.push_back(here.energy);
    ++fit.steps;
    ended = before - here.energy < kLeastFall * before;
    damping = std::max(kLeastDamping, damping / kDampingFactor);
  }
  fit.energy = here.energy;
  fit.mean_square = here.mean_square;
  return fit;
}

CodeFit CodeFitter::SolveByAdam(const Task& task) {
  CodeFit fit;
  torch::Tensor code = code_.clone();
  torch::optim::Adam adam({code}, torch::optim::AdamOptions(options_.learning_rate));
  const auto look = [&]() -> CodeEnergyValue {
    CodeEnergyValue here = fit.energies.empty() ? AtStart(objective_, code) : objective_.At(code);
    if (fit.energies.empty() || here.energy < fit.energy) {
      fit.code = code.clone();
      fit.energy = here.energy;
      fit.mean_square = here.mean_square;
    }
    fit.energies.push_back(here.energy);
    return here;
  };
  for (; fit.steps < options_.adam_steps; ++fit.steps) {
    task.ThrowIfCancelled("the fit of a code was stopped after {} steps", fit.steps);
    task.Report(fit.steps, options_.adam_steps, "steps");
    code.mutable_grad() = look().gradient;
    adam.step();
  }
  look();
  task.Report(fit.steps, options_.adam_steps, "steps");
  return fit;
}

CodeFit FitCode(DeformNetwork& network, CodeEnergy energy, const CodeSolveOptions& options,
                const std::optional<torch::Tensor>& start, const Task& task) {
  return CodeFitter(network, std::move(energy), options, start).Solve(task);
}

CodeFit FitCode(DeformNetwork& network, const SurfacePoints& points, const torch::Tensor& targets,
                const CodeFitOptions& options, const Task& task) {
  CodeEnergy energy;
  energy.all_points = AllPointsTerm{points, targets, options.data_weight};
  energy.prior.weight = options.code_weight;
  return FitCode(network, std::move(energy), options.solve, std::nullopt, task);
}

CodeFit FitCode(DeformNetwork& network, const torch::Tensor& vertices, const CodeFitOptions& options,
                const Task& task) {
  return FitCode(network, VerticesAsPoints(network.template_vertices()), vertices, options, task);
}

}  // namespace daumier::deform
