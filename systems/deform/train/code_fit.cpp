#include "systems/deform/train/code_fit.h"

#include "core/error.h"
#include "core/random.h"
#include "tensor/eigen.h"
#include "tensor/shape.h"
#include "tensor/torch_version.h"

#include <torch/csrc/autograd/autograd.h>
#include <torch/optim/adam.h>
#include <Eigen/Cholesky>

#include <algorithm>
#include <chrono>
#include <numeric>
#include <optional>

namespace daumier::deform {
namespace {

/// Step of the forward differences: a thirtieth of the deviation 0.01 with which codes begin their training, and far
/// enough above float32's rounding of positions.
constexpr double kDifference = 3e-4;
/// Damping as a share of the matrix' mean diagonal: where it begins, from where it is raised, by which factor, and how
/// often in one step.
constexpr double kLeastDamping = 1e-9, kFirstDamping = 1e-2, kDampingFactor = 10;
constexpr int kMostTrials = 8;
constexpr double kLeastFall = 1e-5;

struct Evaluation {
  double energy = 0, mean_square = 0;
  torch::Tensor gradient;  ///< (M)
};

/// The energy of one face.
class CodeEnergy {
 public:
  CodeEnergy(DeformNetwork& network, const SurfacePoints& points, const torch::Tensor& targets,
             const CodeFitOptions& options)
      : network_(network), points_(points), targets_(targets), options_(options) {
    tensor::CheckShape(targets, {points.positions.size(0), 3}, "targets");
    tensor::CheckShape(points.positions, targets.sizes(), "points.positions");
    DAUMIER_CHECK(targets.size(0) > 0, "a code is to be fitted to no point");
  }

  torch::Tensor Zero() const { return torch::zeros({num_numbers()}, targets_.options().dtype(torch::kFloat32)); }
  int64_t num_numbers() const { return network_.options().latent; }
  int64_t num_points() const { return targets_.size(0); }

  Evaluation At(const torch::Tensor& code) const {
    const at::AutoGradMode with_gradient(true);
    const torch::Tensor z = code.detach().clone().requires_grad_(true);
    const torch::Tensor positions = network_.Deform(z.unsqueeze(0), points_).squeeze(0);
    // Sums in float64, so that small falls are seen.
    const torch::Tensor mean_square = (positions - targets_).to(torch::kFloat64).square().mean();
    const torch::Tensor energy =
        options_.data_weight * mean_square + options_.code_weight * z.to(torch::kFloat64).square().mean();
    return {energy.item<double>(), mean_square.item<double>(), torch::autograd::grad({energy}, {z}).front()};
  }

  /// Half the second derivatives by the code, those of the points left out: data_weight / 3S J^T J + code_weight / M of
  /// S points, by forward differences, all in one batch.
  Eigen::MatrixXd HalfHessian(const torch::Tensor& code, const torch::Tensor& rows) const {
    const at::NoGradGuard no_gradient;
    const int64_t m = num_numbers();
    const SurfacePoints subset{points_.corners.index_select(0, rows), points_.weights.index_select(0, rows),
                                       points_.positions.index_select(0, rows)};
    const torch::Tensor moves = torch::cat({Zero().unsqueeze(0), kDifference * torch::eye(m, code.options())});
    const torch::Tensor positions = network_.Deform(code + moves, subset).reshape({m + 1, -1});
    const torch::Tensor tangents = (positions.slice(0, 1) - positions.slice(0, 0, 1)) / kDifference;
    const torch::Tensor gram = torch::matmul(tangents, tangents.t()) * (options_.data_weight / tangents.size(1));
    Eigen::MatrixXd hessian = tensor::CopyToMatrix<double>(gram);
    hessian.diagonal().array() += options_.code_weight / m;
    return hessian;
  }

 private:
  DeformNetwork& network_;
  const SurfacePoints& points_;
  const torch::Tensor& targets_;
  const CodeFitOptions& options_;
};

/// `count` different numbers of 0 .. num_points - 1, ascending.
torch::Tensor DrawRows(int64_t num_points, int64_t count, Rng& rng, torch::Device device) {
  std::vector<int64_t> indices(static_cast<size_t>(num_points));
  std::iota(indices.begin(), indices.end(), int64_t(0));
  const size_t num_rows = size_t(std::min(count, num_points));
  for (size_t i = 0; i < num_rows; ++i) std::swap(indices[i], indices[i + rng.Below(indices.size() - i)]);
  std::sort(indices.begin(), indices.begin() + std::ptrdiff_t(num_rows));
  return torch::tensor(at::ArrayRef<int64_t>(indices.data(), num_rows)).to(device);
}

CodeFit FitByGaussNewton(const CodeEnergy& energy, const CodeFitOptions& options) {
  CodeFit fit;
  fit.code = energy.Zero();
  Evaluation here = energy.At(fit.code);
  fit.energies = {here.energy};
  double damping = kLeastDamping;

  /// The first step of growing damping that lowers the energy.
  const auto lower = [&](const Eigen::MatrixXd& hessian) -> std::optional<torch::Tensor> {
    const Eigen::VectorXd half_gradient = tensor::CopyToMatrix<double>(here.gradient.unsqueeze(1)) / 2;
    for (int trial = 0; trial < kMostTrials; ++trial) {
      Eigen::MatrixXd damped = hessian;
      damped.diagonal().array() += damping * hessian.diagonal().mean();
      const Eigen::VectorXd step = damped.ldlt().solve(-half_gradient);
      const torch::Tensor code = fit.code + tensor::CopyToTensor(step).to(fit.code.options());
      Evaluation there = energy.At(code);
      if (there.energy < here.energy) {
        here = std::move(there);
        return code;
      }
      damping = std::max(kFirstDamping, kDampingFactor * damping);
    }
    return std::nullopt;
  };

  for (int step = 0; step < options.newton_steps; ++step) {
    Rng rng = Stream(options.seed, "rows of a code fit", uint64_t(step));
    const std::optional<torch::Tensor> code =
        lower(energy.HalfHessian(fit.code, DrawRows(energy.num_points(), options.num_rows, rng, fit.code.device())));
    if (!code) break;
    fit.code = *code;
    fit.energies.push_back(here.energy);
    ++fit.steps;
    const double before = fit.energies[fit.energies.size() - 2];
    if (before - here.energy < kLeastFall * before) break;
    damping = std::max(kLeastDamping, damping / kDampingFactor);
  }
  fit.energy = here.energy;
  fit.mean_square = here.mean_square;
  return fit;
}

CodeFit FitByAdam(const CodeEnergy& energy, const CodeFitOptions& options) {
  CodeFit fit;
  torch::Tensor code = energy.Zero();
  torch::optim::Adam adam({code}, torch::optim::AdamOptions(options.learning_rate));
  const auto look = [&]() -> Evaluation {
    Evaluation here = energy.At(code);
    if (fit.energies.empty() || here.energy < fit.energy) {
      fit.code = code.clone();
      fit.energy = here.energy;
      fit.mean_square = here.mean_square;
    }
    fit.energies.push_back(here.energy);
    return here;
  };
  for (; fit.steps < options.adam_steps; ++fit.steps) {
    code.mutable_grad() = look().gradient;
    adam.step();
  }
  look();
  return fit;
}

}  // namespace

CodeFit FitCode(DeformNetwork& network, const SurfacePoints& points, const torch::Tensor& targets,
                const CodeFitOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  const CodeEnergy energy(network, points, targets, options);
  CodeFit fit = options.method == "adam" ? FitByAdam(energy, options) : FitByGaussNewton(energy, options);
  fit.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return fit;
}

CodeFit FitCode(DeformNetwork& network, const torch::Tensor& vertices, const CodeFitOptions& options) {
  return FitCode(network, VerticesAsPoints(network.template_vertices()), vertices, options);
}

}  // namespace daumier::deform
