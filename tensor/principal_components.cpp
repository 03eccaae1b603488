#include "tensor/principal_components.h"

#include "core/error.h"
#include "tensor/shape.h"
#include "tensor/torch_version.h"

#include <ATen/CPUGeneratorImpl.h>
#include <torch/linalg.h>

#include <algorithm>

namespace daumier::tensor {
namespace {

constexpr int64_t kOversampling = 16;
constexpr int kRounds = 6;
/// A direction that explains a smaller share than this of the first one's variance is rounding.
constexpr double kLeastShare = 1e-10;

torch::Tensor Orthonormal(const torch::Tensor& columns) {
  return std::get<0>(torch::linalg_qr(columns));
}

}  // namespace

int PrincipalComponents::NumFor(double share) const {
  const torch::Tensor explained = deviations.to(torch::kFloat64).square().cumsum(0);
  return int((explained < share * total_variance).sum().item<int64_t>()) + 1;
}

PrincipalComponents FitPrincipalComponents(torch::Tensor& rows, int size) {
  CheckShape(rows, {kAny, kAny}, "rows");
  const int64_t n = rows.size(0);
  DAUMIER_CHECK(size > 0 && size <= std::min(n, rows.size(1)), "{} principal components of {} rows of {} numbers", size,
                n, rows.size(1));
  const at::NoGradGuard no_gradient;
  PrincipalComponents components;
  components.mean = rows.mean(0);
  rows.sub_(components.mean);

  // The column space of the rows' n x n Gram matrix, which is never made.
  const int64_t width = std::min({size + kOversampling, n, rows.size(1)});
  torch::Tensor space = Orthonormal(torch::randn({n, width}, at::detail::createCPUGenerator(1)).to(rows.device()));
  for (int round = 0; round < kRounds; ++round)
    space = Orthonormal(torch::matmul(rows, torch::matmul(rows.t(), space)));
  const torch::Tensor projected = torch::matmul(space.t(), rows);
  const torch::Tensor gram = torch::matmul(projected, projected.t()).to(torch::kFloat64);
  const auto [ascending, vectors] = torch::linalg_eigh(gram);
  const torch::Tensor squares = ascending.flip(0).slice(0, 0, size);
  DAUMIER_CHECK(squares[size - 1].item<double>() > kLeastShare * squares[0].item<double>(),
                "{} principal components are asked of rows that span fewer", size);
  const torch::Tensor turned = (vectors.flip(1).slice(1, 0, size) / squares.sqrt()).t().to(rows.scalar_type());
  components.directions = torch::matmul(turned, projected);
  components.deviations = (squares / double(n)).sqrt().to(rows.scalar_type());
  components.total_variance = rows.square().sum(1).to(torch::kFloat64).mean().item<double>();
  return components;
}

}  // namespace daumier::tensor
