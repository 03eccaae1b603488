#include "systems/deform/train/code_energy.h"

#include "core/error.h"
#include "tensor/eigen.h"
#include "tensor/shape.h"
#include "tensor/torch_version.h"

#include <torch/csrc/autograd/autograd.h>

#include <cmath>
#include <utility>

namespace daumier::deform {
namespace {

/// Step of the forward differences: a thirtieth of the deviation 0.01 with which codes begin their training, and far
/// enough above float32's rounding of positions.
constexpr double kDifference = 3e-4;

void CheckFinite(const torch::Tensor& numbers, const char* name) {
  const int64_t wrong = numbers.numel() - torch::isfinite(numbers).sum().item<int64_t>();
  DAUMIER_CHECK(wrong == 0, "{}: {} of {} numbers are not finite", name, wrong, numbers.numel());
}

void CheckWeight(double weight, const char* name) {
  DAUMIER_CHECK(std::isfinite(weight) && weight >= 0, "{} is {}, expected a finite number of at least 0", name, weight);
}

void CheckTargets(const SurfacePoints& points, const torch::Tensor& targets, const char* name) {
  tensor::CheckShape(targets, {points.positions.size(0), 3}, name);
  tensor::CheckShape(points.positions, targets.sizes(), "points.positions");
  DAUMIER_CHECK(targets.size(0) > 0, "a code is to be fitted to no point");
  CheckFinite(targets, name);
  CheckFinite(points.positions, "points.positions");
}

SurfacePoints Joined(const std::vector<SurfacePoints>& parts) {
  if (parts.empty()) return {};
  if (parts.size() == 1) return parts.front();
  std::vector<torch::Tensor> corners, weights, positions;
  for (const SurfacePoints& part : parts) {
    corners.push_back(part.corners);
    weights.push_back(part.weights);
    positions.push_back(part.positions);
  }
  return {torch::cat(corners), torch::cat(weights), torch::cat(positions)};
}

SurfacePoints Rows(const SurfacePoints& points, const torch::Tensor& rows) {
  return {points.corners.index_select(0, rows), points.weights.index_select(0, rows),
          points.positions.index_select(0, rows)};
}

/// Mean over 3P coordinates of w_i (squared distance of coordinates), in float64.
torch::Tensor WeightedMeanSquare(const torch::Tensor& positions, const SparsePointsTerm& term) {
  const torch::Tensor squares = (positions - term.targets).to(torch::kFloat64).square();
  return (squares * term.weights.to(torch::kFloat64).unsqueeze(1)).mean();
}

}  // namespace

SurfacePoints VertexPoints(const DeformNetwork& network, std::span<const int> vertices) {
  for (const int vertex : vertices)
    DAUMIER_CHECK(vertex >= 0 && vertex < network.num_vertices(), "vertex {} of a template of {}", vertex,
                  network.num_vertices());
  const torch::Tensor rows = torch::tensor(std::vector<int64_t>(vertices.begin(), vertices.end()), torch::kInt64)
                                 .to(network.template_vertices().device());
  return Rows(VerticesAsPoints(network.template_vertices()), rows);
}

CodeObjective::CodeObjective(DeformNetwork& network, CodeEnergy energy)
    : network_(network), energy_(std::move(energy)) {
  std::vector<SurfacePoints> parts;
  for (const SparsePointsTerm& term : energy_.sparse_points) {
    CheckTargets(term.points, term.targets, "targets of sparse points");
    tensor::CheckShape(term.weights, {term.targets.size(0)}, "weights of sparse points");
    CheckFinite(term.weights, "weights of sparse points");
    DAUMIER_CHECK(term.weights.min().item<double>() >= 0,
                  "weights of sparse points: the least is {}, expected 0 or more", term.weights.min().item<double>());
    CheckWeight(term.weight, "weight of sparse points");
    parts.push_back(term.points);
  }
  sparse_ = Joined(parts);
  if (energy_.all_points) {
    CheckTargets(energy_.all_points->points, energy_.all_points->targets, "targets");
    CheckWeight(energy_.all_points->weight, "weight of all points");
    parts.insert(parts.begin(), energy_.all_points->points);
  }
  points_ = Joined(parts);
  CheckWeight(energy_.prior.weight, "weight of the prior");
  if (energy_.prior.mean) {
    tensor::CheckShape(*energy_.prior.mean, {num_numbers()}, "mean of the prior");
    CheckFinite(*energy_.prior.mean, "mean of the prior");
  }
}

torch::Tensor CodeObjective::Zero() const {
  return torch::zeros({num_numbers()}, network_.template_vertices().options());
}

CodeEnergyValue CodeObjective::At(const torch::Tensor& code) const {
  tensor::CheckShape(code, {num_numbers()}, "code");
  const at::AutoGradMode with_gradient(true);
  const torch::Tensor z = code.detach().clone().requires_grad_(true);
  torch::Tensor positions;
  if (points_.positions.defined()) positions = network_.Deform(z.unsqueeze(0), points_).squeeze(0);
  CodeEnergyValue value;
  // Sums in float64, so that small falls are seen.
  torch::Tensor energy;
  const auto add = [&](const torch::Tensor& term) -> double {
    energy = energy.defined() ? energy + term : term;
    return term.item<double>();
  };
  if (energy_.all_points) {
    const torch::Tensor mean_square =
        (positions.slice(0, 0, num_points()) - energy_.all_points->targets).to(torch::kFloat64).square().mean();
    value.mean_square = mean_square.item<double>();
    value.all_points = add(energy_.all_points->weight * mean_square);
  }
  int64_t begin = num_points();
  for (const SparsePointsTerm& term : energy_.sparse_points) {
    const int64_t end = begin + term.targets.size(0);
    value.sparse_points.push_back(add(term.weight * WeightedMeanSquare(positions.slice(0, begin, end), term)));
    begin = end;
  }
  const torch::Tensor from_mean = energy_.prior.mean ? z - *energy_.prior.mean : z;
  value.prior = add(energy_.prior.weight * from_mean.to(torch::kFloat64).square().mean());
  value.energy = energy.item<double>();
  value.gradient = torch::autograd::grad({energy}, {z}).front();
  return value;
}

Eigen::MatrixXd CodeObjective::HalfHessian(const torch::Tensor& code, const torch::Tensor& rows) const {
  tensor::CheckShape(code, {num_numbers()}, "code");
  const at::NoGradGuard no_gradient;
  const int64_t m = num_numbers();
  std::vector<SurfacePoints> parts;
  if (energy_.all_points) parts.push_back(Rows(energy_.all_points->points, rows));
  if (!energy_.sparse_points.empty()) parts.push_back(sparse_);
  Eigen::MatrixXd hessian = Eigen::MatrixXd::Zero(m, m);
  if (!parts.empty()) {
    const torch::Tensor moves = torch::cat({Zero().unsqueeze(0), kDifference * torch::eye(m, code.options())});
    const torch::Tensor positions = network_.Deform(code + moves, Joined(parts)).reshape({m + 1, -1});
    const torch::Tensor tangents = (positions.slice(0, 1) - positions.slice(0, 0, 1)) / kDifference;
    int64_t begin = 0;
    if (energy_.all_points) {
      begin = 3 * rows.size(0);
      const torch::Tensor of_term = tangents.slice(1, 0, begin);
      hessian += tensor::CopyToMatrix<double>(torch::matmul(of_term, of_term.t()) *
                                              (energy_.all_points->weight / double(begin)));
    }
    for (const SparsePointsTerm& term : energy_.sparse_points) {
      const int64_t end = begin + 3 * term.targets.size(0);
      const torch::Tensor of_term = tangents.slice(1, begin, end);
      const torch::Tensor weights = term.weights.to(of_term.options()).repeat_interleave(3);
      hessian += tensor::CopyToMatrix<double>(torch::matmul(of_term * weights, of_term.t()) *
                                              (term.weight / double(end - begin)));
      begin = end;
    }
  }
  hessian.diagonal().array() += energy_.prior.weight / double(m);
  return hessian;
}

void CodeObjective::MoveTargets(size_t sparse_term, const torch::Tensor& targets) {
  DAUMIER_CHECK(sparse_term < energy_.sparse_points.size(), "term {} of {} of sparse points", sparse_term,
                energy_.sparse_points.size());
  SparsePointsTerm& term = energy_.sparse_points[sparse_term];
  CheckTargets(term.points, targets, "targets of sparse points");
  term.targets = targets;
}

}  // namespace daumier::deform
