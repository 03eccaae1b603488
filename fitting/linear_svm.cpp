#include "fitting/linear_svm.h"

#include "core/error.h"

#include <linear.h>

#include <algorithm>
#include <array>
#include <memory>

namespace daumier::fitting {
namespace {

constexpr int kParts = 4;

/// Versions from 2.40 on have a switch for 1/2 b^2.
template <class Parameter>
void RegulariseOffset(Parameter& parameter) {
  if constexpr (requires { parameter.regularize_bias; }) parameter.regularize_bias = 1;
}

struct FreeModel {
  void operator()(::model* model) const { ::free_and_destroy_model(&model); }
};

/// The rows of a matrix as liblinear reads them, each with a 1 for the offset at its end.
class SvmRows {
 public:
  explicit SvmRows(const Eigen::MatrixXd& points) : nodes_(size_t(points.rows() * (points.cols() + 2))) {
    auto node = nodes_.begin();
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
      rows_.push_back(&*node);
      for (Eigen::Index k = 0; k < points.cols(); ++k) *node++ = {int(k) + 1, points(i, k)};
      *node++ = {int(points.cols()) + 1, 1};
      *node++ = {-1, 0};
    }
  }
  ::feature_node** rows() { return rows_.data(); }

 private:
  std::vector<::feature_node> nodes_;
  std::vector<::feature_node*> rows_;
};

}  // namespace

SeparatingPlane TrainLinearSvm(const Eigen::MatrixXd& points, const std::vector<bool>& is_second, double cost) {
  DAUMIER_CHECK(points.rows() == std::ssize(is_second), "{} points of {} kinds", points.rows(), is_second.size());
  DAUMIER_CHECK(points.allFinite() && cost > 0, "a support vector machine of cost {} with {} numbers not finite", cost,
                points.size() - points.array().isFinite().count());
  const auto num_second = double(std::ranges::count(is_second, true)), num_all = double(is_second.size());
  DAUMIER_CHECK(num_second > 0 && num_second < num_all, "{} of {} points are of the second kind, expected both kinds",
                num_second, num_all);
  std::vector<double> sides;
  for (const bool second : is_second) sides.push_back(second ? 1 : -1);
  SvmRows rows(points);
  ::problem problem{};
  problem.l = int(points.rows());
  problem.n = int(points.cols()) + 1;
  problem.y = sides.data();
  problem.x = rows.rows();
  problem.bias = 1;
  std::array<int, 2> labels = {-1, 1};
  std::array<double, 2> weights = {num_all / (2 * (num_all - num_second)), num_all / (2 * num_second)};
  ::parameter parameter{};
  parameter.solver_type = L2R_L2LOSS_SVC;
  parameter.eps = 1e-5;
  parameter.C = cost;
  parameter.nr_weight = int(labels.size());
  parameter.weight_label = labels.data();
  parameter.weight = weights.data();
  RegulariseOffset(parameter);
  ::set_print_string_function([](const char*) {});
  const std::unique_ptr<::model, FreeModel> trained(::train(&problem, &parameter));
  // The model's numbers are those of the kind that it met first.
  const double sign = trained->label[0] == 1 ? 1 : -1;
  const Eigen::Map<const Eigen::VectorXd> numbers(trained->w, points.cols() + 1);
  return {sign * numbers.head(points.cols()), sign * numbers[points.cols()]};
}

double BalancedAccuracy(const SeparatingPlane& plane, const Eigen::MatrixXd& points,
                        const std::vector<bool>& is_second) {
  DAUMIER_CHECK(points.rows() == std::ssize(is_second) && points.cols() == plane.normal.size(),
                "{} x {} points of {} kinds and a plane of {} numbers", points.rows(), points.cols(), is_second.size(),
                plane.normal.size());
  std::array<double, 2> counts = {0, 0}, right = {0, 0};
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const bool second = is_second[size_t(i)];
    ++counts[second];
    right[second] += (points.row(i).dot(plane.normal) + plane.offset > 0) == second ? 1 : 0;
  }
  DAUMIER_CHECK(counts[0] > 0 && counts[1] > 0, "{} and {} points of two kinds, expected both", counts[0], counts[1]);
  return (right[0] / counts[0] + right[1] / counts[1]) / 2;
}

double BestSvmCost(const Eigen::MatrixXd& points, const std::vector<bool>& is_second) {
  DAUMIER_CHECK(points.rows() == std::ssize(is_second), "{} points of {} kinds", points.rows(), is_second.size());
  struct Part {
    Eigen::MatrixXd trained, held_out;
    std::vector<bool> of_trained, of_held_out;
  };
  std::vector<int> part_of;  // Each kind in turn, so that every part has both.
  std::array<int, 2> counts = {0, 0};
  for (const bool second : is_second) part_of.push_back(counts[second]++ % kParts);
  std::vector<Part> parts;
  for (int part = 0; part < kParts; ++part) {
    std::vector<Eigen::Index> trained, held_out;
    Part& some = parts.emplace_back();
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
      const bool is_held_out = part_of[size_t(i)] == part;
      (is_held_out ? held_out : trained).push_back(i);
      (is_held_out ? some.of_held_out : some.of_trained).push_back(is_second[size_t(i)]);
    }
    some.trained = points(trained, Eigen::all);
    some.held_out = points(held_out, Eigen::all);
  }
  double best_cost = 0, best = -1;
  for (const double cost : {1e-4, 1e-3, 1e-2, 1e-1, 1.0}) {
    double sum = 0;
    for (const Part& part : parts)
      sum += BalancedAccuracy(TrainLinearSvm(part.trained, part.of_trained, cost), part.held_out, part.of_held_out);
    if (sum > best + 1e-9) best = sum, best_cost = cost;
  }
  return best_cost;
}

}  // namespace daumier::fitting
