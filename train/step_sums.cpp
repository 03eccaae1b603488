#include "train/step_sums.h"

#include "tensor/torch_version.h"

#include <ATen/Functions.h>

#include <cmath>

namespace daumier::train {

void StepSums::Add(int64_t step, const std::map<std::string, torch::Tensor>& numbers) {
  const at::NoGradGuard no_grad;
  std::vector<std::string> names;
  std::vector<torch::Tensor> scalars;
  for (const auto& [name, number] : numbers) {
    names.push_back(name);
    scalars.push_back(number.detach().to(torch::kFloat64));
  }
  const torch::Tensor row = at::stack(scalars);
  if (names != names_) {
    totals_ = Totals();
    names_ = names;
    std::vector<double> sums;  // Continued, so that a sum does not depend on where it was saved.
    for (const std::string& name : names) {
      sums.push_back(totals_[name]);
      totals_.erase(name);
    }
    sums_ = at::tensor(sums, torch::kFloat64).to(row.device());
    bad_numbers_ = at::zeros_like(row);
    bad_step_ = at::full({}, -1, row.options().dtype(torch::kInt64));
  }
  sums_ += row;
  const torch::Tensor is_first = row.isfinite().all().logical_not().logical_and(bad_step_ < 0);
  bad_numbers_ = at::where(is_first, row, bad_numbers_);
  bad_step_.masked_fill_(is_first, step);
  ++num_steps_;
}

std::map<std::string, double> StepSums::Totals() const {
  std::map<std::string, double> totals = totals_;
  if (!sums_.defined()) return totals;
  const torch::Tensor sums = sums_.to(torch::kCPU);
  for (size_t i = 0; i < names_.size(); ++i) totals[names_[i]] += sums.data_ptr<double>()[i];
  return totals;
}

void StepSums::Clear() {
  totals_.clear();
  num_steps_ = 0;
  if (sums_.defined()) sums_.zero_();
}

void StepSums::Load(std::map<std::string, double> totals, int num_steps) {
  *this = StepSums();
  totals_ = std::move(totals);
  num_steps_ = num_steps;
}

std::optional<NotFinite> StepSums::FirstNotFinite() const {
  if (!bad_step_.defined()) return std::nullopt;
  const int64_t step = bad_step_.item<int64_t>();
  if (step < 0) return std::nullopt;
  const torch::Tensor numbers = bad_numbers_.to(torch::kCPU);
  std::optional<NotFinite> found;
  const auto rank = [](const std::string& name) { return name == "loss" ? 0 : name == "gradient_norm" ? 2 : 1; };
  for (size_t i = 0; i < names_.size(); ++i) {
    const double number = numbers.data_ptr<double>()[i];
    if (!std::isfinite(number) && (!found || rank(names_[i]) < rank(found->name)))
      found = NotFinite{step, names_[i], number};
  }
  return found;
}

}  // namespace daumier::train
