#include "fitting/code_directions.h"

#include "core/error.h"
#include "core/options.h"
#include "fitting/linear_svm.h"

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

Eigen::VectorXd ValuesOf(const LabelledCodes& faces, const std::string& label) {
  const auto found = std::find(faces.names.begin(), faces.names.end(), label);
  if (found == faces.names.end()) {
    const std::string nearest = NearestWord(label, {faces.names.begin(), faces.names.end()});
    throw UsageError(fmt::format("there is no label '{}'{} (there are: {})", label,
                                 nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest),
                                 fmt::join(faces.names, ", ")));
  }
  return faces.labels.col(found - faces.names.begin());
}

/// The faces of both sides that a direction is made of.
struct TrainedSides {
  std::vector<Eigen::Index> rows;
  std::vector<bool> is_high;
  int counts[2] = {0, 0};
};

TrainedSides SidesTrained(const std::vector<int>& sides) {
  TrainedSides trained;
  for (size_t i = 0; i < sides.size(); ++i) {
    if (sides[i] < 0 || i % kHeldOut == kHeldOut - 1) continue;
    trained.rows.push_back(Eigen::Index(i));
    trained.is_high.push_back(sides[i] == 1);
    ++trained.counts[sides[i]];
  }
  return trained;
}

/// A plane across the direction.
SeparatingPlane PlaneOfMeans(const Eigen::MatrixXd& codes, const TrainedSides& trained) {
  Eigen::VectorXd means[2] = {Eigen::VectorXd::Zero(codes.cols()), Eigen::VectorXd::Zero(codes.cols())};
  for (size_t i = 0; i < trained.rows.size(); ++i)
    means[trained.is_high[i]] += codes.row(trained.rows[i]).transpose() / trained.counts[trained.is_high[i]];
  const Eigen::VectorXd difference = means[1] - means[0];
  return {difference, -difference.dot(means[0] + means[1]) / 2};
}

SeparatingPlane PlaneOfSvm(const Eigen::MatrixXd& codes, const TrainedSides& trained) {
  const Eigen::MatrixXd points = codes(trained.rows, Eigen::all);
  return TrainLinearSvm(points, trained.is_high, BestSvmCost(points, trained.is_high));
}

/// How much a label grows along a place; `deviation` is the label's.
struct LabelSlope {
  double slope = 0, deviation = 0;
};

LabelSlope SlopeOf(const Eigen::VectorXd& values, const Eigen::VectorXd& places) {
  double count = 0, mean_value = 0, mean_place = 0, variance = 0, place_variance = 0, covariance = 0;
  for (Eigen::Index row = 0; row < values.size(); ++row) count += std::isfinite(values[row]) ? 1 : 0;
  for (Eigen::Index row = 0; row < values.size(); ++row)
    if (std::isfinite(values[row])) mean_value += values[row] / count, mean_place += places[row] / count;
  for (Eigen::Index row = 0; row < values.size(); ++row) {
    if (!std::isfinite(values[row])) continue;
    variance += std::pow(values[row] - mean_value, 2) / count;
    place_variance += std::pow(places[row] - mean_place, 2);
    covariance += (values[row] - mean_value) * (places[row] - mean_place);
  }
  return {covariance / place_variance, std::sqrt(variance)};
}

/// The share of the faces on their side of a threshold, of those that `counts` takes by their place in the list.
template <class Counts>
std::optional<double> ShareRight(const std::vector<int>& sides, const Eigen::VectorXd& places, double threshold,
                                 Counts&& counts) {
  int num = 0, num_right = 0;
  for (size_t i = 0; i < sides.size(); ++i) {
    if (sides[i] < 0 || !counts(i)) continue;
    ++num;
    num_right += (places[Eigen::Index(i)] > threshold) == (sides[i] == 1) ? 1 : 0;
  }
  if (num == 0) return std::nullopt;
  return double(num_right) / num;
}

}  // namespace

CodeDirection DirectionOf(const LabelledCodes& faces, const std::string& label, DirectionMethod method) {
  const Eigen::VectorXd values = ValuesOf(faces, label);
  const std::vector<int> sides = SidesOf(values);
  const TrainedSides trained = SidesTrained(sides);
  DAUMIER_CHECK(trained.counts[0] >= kFewestOfSide && trained.counts[1] >= kFewestOfSide,
                "the label '{}' has {} faces without and {} with it, expected {} or more of each", label,
                trained.counts[0], trained.counts[1], kFewestOfSide);
  const SeparatingPlane plane =
      method == DirectionMethod::kSvm ? PlaneOfSvm(faces.codes, trained) : PlaneOfMeans(faces.codes, trained);
  const double length = plane.normal.norm();
  DAUMIER_CHECK(length > 0, "the label '{}' does not depend on the code", label);
  const Eigen::VectorXd direction = plane.normal / length, places = faces.codes * direction;
  CodeDirection result;
  result.threshold = -plane.offset / length;
  result.num_low = trained.counts[0], result.num_high = trained.counts[1];
  const auto is_held_out = [](size_t i) { return i % kHeldOut == kHeldOut - 1; };
  result.accuracy = ShareRight(sides, places, result.threshold, is_held_out).value_or(0);
  const LabelSlope growth = SlopeOf(values, places);
  DAUMIER_CHECK(growth.slope > 0, "the label '{}' does not grow with its direction", label);
  result.step = growth.deviation / growth.slope * direction;
  return result;
}

std::optional<double> AccuracyOn(const LabelledCodes& faces, const std::string& label, const CodeDirection& direction) {
  const std::vector<int> sides = SidesOf(ValuesOf(faces, label));
  if (std::ranges::count(sides, 0) == 0 || std::ranges::count(sides, 1) == 0) return std::nullopt;
  return ShareRight(sides, faces.codes * direction.step.normalized(), direction.threshold, [](size_t) { return true; });
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
