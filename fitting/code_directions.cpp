#include "fitting/code_directions.h"

#include "core/error.h"
#include "core/options.h"

#include <fmt/ranges.h>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>

namespace daumier::fitting {
namespace {

constexpr int kFewestOfSide = 4;
/// One face in this number is held out to measure a direction.
constexpr int kHeldOut = 5;

/// The faces of each side of a label: 0 low, 1 high, -1 neither.
std::vector<int> SidesOf(const Eigen::VectorXd& values) {
  std::vector<double> sorted;
  for (const double value : values)
    if (std::isfinite(value)) sorted.push_back(value);
  std::sort(sorted.begin(), sorted.end());
  std::vector<int> sides(size_t(values.size()), -1);
  if (sorted.empty() || sorted.front() == sorted.back()) return sides;
  double low = sorted.front(), high = sorted.back();
  const bool is_binary =
      std::all_of(sorted.begin(), sorted.end(), [&](double value) { return value == low || value == high; });
  if (!is_binary) {
    low = sorted[sorted.size() / 3];
    high = sorted[sorted.size() - 1 - sorted.size() / 3];
  }
  for (size_t i = 0; i < sides.size(); ++i) {
    const double value = values[Eigen::Index(i)];
    if (std::isfinite(value)) sides[i] = value >= high ? 1 : value <= low ? 0 : -1;
  }
  return sides;
}

}  // namespace

CodeDirection DirectionOf(const LabelledCodes& faces, const std::string& label) {
  const auto found = std::find(faces.names.begin(), faces.names.end(), label);
  if (found == faces.names.end()) {
    const std::string nearest = NearestWord(label, {faces.names.begin(), faces.names.end()});
    throw UsageError(fmt::format("there is no label '{}'{} (there are: {})", label,
                                 nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest),
                                 fmt::join(faces.names, ", ")));
  }
  const Eigen::VectorXd values = faces.labels.col(found - faces.names.begin());
  const std::vector<int> sides = SidesOf(values);
  const Eigen::Index num_numbers = faces.codes.cols();
  Eigen::VectorXd means[2] = {Eigen::VectorXd::Zero(num_numbers), Eigen::VectorXd::Zero(num_numbers)};
  int counts[2] = {0, 0}, num_labelled = 0;
  for (size_t i = 0; i < sides.size(); ++i) {
    if (std::isfinite(values[Eigen::Index(i)])) ++num_labelled;
    if (sides[i] < 0 || i % kHeldOut == kHeldOut - 1) continue;
    means[sides[i]] += faces.codes.row(Eigen::Index(i)).transpose();
    ++counts[sides[i]];
  }
  DAUMIER_CHECK(counts[0] >= kFewestOfSide && counts[1] >= kFewestOfSide,
                "the label '{}' has {} faces without and {} with it, expected {} or more of each", label, counts[0],
                counts[1], kFewestOfSide);
  for (int side = 0; side < 2; ++side) means[side] /= counts[side];
  const Eigen::VectorXd difference = means[1] - means[0];
  DAUMIER_CHECK(difference.norm() > 0, "the label '{}' does not depend on the code", label);
  const Eigen::VectorXd direction = difference.normalized();
  const Eigen::VectorXd places = faces.codes * direction;
  const double middle = direction.dot(means[0] + means[1]) / 2;

  CodeDirection result;
  result.num_low = counts[0], result.num_high = counts[1];
  int num_held_out = 0, num_right = 0;
  double mean_value = 0, mean_place = 0;
  for (size_t i = 0; i < sides.size(); ++i) {
    const Eigen::Index row(i);
    if (std::isfinite(values[row])) mean_value += values[row] / num_labelled, mean_place += places[row] / num_labelled;
    if (sides[i] < 0 || i % kHeldOut != kHeldOut - 1) continue;
    ++num_held_out;
    num_right += (places[row] > middle) == (sides[i] == 1) ? 1 : 0;
  }
  result.accuracy = num_held_out > 0 ? double(num_right) / num_held_out : 0;
  double variance = 0, place_variance = 0, covariance = 0;
  for (Eigen::Index row = 0; row < values.size(); ++row) {
    if (!std::isfinite(values[row])) continue;
    variance += std::pow(values[row] - mean_value, 2);
    place_variance += std::pow(places[row] - mean_place, 2);
    covariance += (values[row] - mean_value) * (places[row] - mean_place);
  }
  const double slope = covariance / place_variance, deviation = std::sqrt(variance / num_labelled);
  DAUMIER_CHECK(slope > 0, "the label '{}' does not grow with its direction", label);
  result.step = deviation / slope * direction;
  return result;
}

Eigen::VectorXd Keeping(const Eigen::VectorXd& step, const std::vector<Eigen::VectorXd>& steps) {
  if (steps.empty()) return step;
  Eigen::MatrixXd others(step.size(), std::ssize(steps));
  for (size_t k = 0; k < steps.size(); ++k) others.col(Eigen::Index(k)) = steps[k];
  const Eigen::VectorXd rest = step - others * others.colPivHouseholderQr().solve(step);
  const double share = rest.squaredNorm() / step.squaredNorm();
  DAUMIER_CHECK(share > 1e-3, "the labels that are kept leave nothing of this edit: {:.2g} of its square is left",
                share);
  return rest / share;
}

}  // namespace daumier::fitting
