#include "datasets/build/landmark_groups.h"

#include "datasets/build/landmark_pairs.h"

#include <algorithm>
#include <numeric>
#include <set>

namespace daumier::datasets {
namespace {

/// Fewer landmarks outside a group do not hold the similarity.
constexpr size_t kFewestOthers = 6;
/// Fewer landmarks of a group hardly have an order.
constexpr size_t kFewestOfGroup = 4;
/// Another order is the right one if its distance falls below this share: right ones of 43 heads reach 0.81 at most,
/// wrong ones of good heads with 10 % noise 1.08 at least.
constexpr double kFarBetterOrder = 0.85;
/// Residuals of outliers are above the first, a share of the spread, and this many times those of the others; good heads
/// have no gap above 2.1.
constexpr double kFarOff = 0.5, kFarAbove = 2.5;
/// More landmarks are no outliers, and each has this many that are none.
constexpr size_t kMostOutliers = 4, kInliersOfOutlier = 6;

/// `first` .. `last` with `sum` less the landmark as the source.
GroupOrder ReversedGroup(std::string fault, int first, int last, int sum) {
  GroupOrder order{std::move(fault), {}, {}};
  for (int l = first; l <= last; ++l) {
    if (sum - l == l) continue;
    order.landmarks.push_back(l);
    order.sources.push_back(sum - l);
  }
  return order;
}

/// Two runs of landmarks of the same length exchanged.
GroupOrder Exchanged(std::string fault, int first, int second, int length) {
  GroupOrder order{std::move(fault), {}, {}};
  for (int l = 0; l < length; ++l) {
    order.landmarks.insert(order.landmarks.end(), {first + l, second + l});
    order.sources.insert(order.sources.end(), {second + l, first + l});
  }
  return order;
}

GroupOrder Mirrored(std::string fault, int first, int last) {
  GroupOrder order{std::move(fault), {}, {}};
  for (int l = first; l <= last; ++l) {
    if (faces::MirroredLandmark(l) == l) continue;
    order.landmarks.push_back(l);
    order.sources.push_back(faces::MirroredLandmark(l));
  }
  return order;
}

std::vector<GroupOrder> MakeGroupOrders() {
  return {Exchanged("the eyes are exchanged (36 to 41 with 42 to 47)", 36, 42, 6),
          Mirrored("the eyes are mirrored (36 with 45, 39 with 42 and so on)", 36, 47),
          Exchanged("the brows are exchanged (17 to 21 with 22 to 26)", 17, 22, 5),
          Mirrored("the brows are reversed (17 to 26)", 17, 26),
          Mirrored("the jaw is reversed (0 to 16)", 0, 16),
          Mirrored("left and right of the mouth are exchanged (48 with 54, 60 with 64 and so on)", 48, 67),
          Mirrored("left and right of the outer lips are exchanged (48 with 54 and so on)", 48, 59),
          Mirrored("left and right of the inner lips are exchanged (60 with 64 and so on)", 60, 67),
          Mirrored("the base of the nose is reversed (31 to 35)", 31, 35),
          ReversedGroup("the ridge of the nose is reversed (27 to 30)", 27, 30, 57),
          ReversedGroup("the right brow is reversed (17 to 21)", 17, 21, 38),
          ReversedGroup("the left brow is reversed (22 to 26)", 22, 26, 48),
          ReversedGroup("the outer lips run the wrong way (49 to 59)", 49, 59, 108)};
}

}  // namespace

const std::vector<GroupOrder>& GroupOrders() {
  static const std::vector<GroupOrder> kOrders = MakeGroupOrders();
  return kOrders;
}

std::optional<GroupFit> FitOfGroup(const FitInput& input, const GroupOrder& order) {
  MeshLandmarks others = input.landmarks;
  for (const int l : order.landmarks) others[size_t(l)].reset();
  const LandmarkPairs fitted = PairsOf(input, others, SameLandmark);
  if (fitted.landmarks.size() < kFewestOthers) return std::nullopt;
  const geometry::Similarity similarity = geometry::AlignRobustly(fitted.places, fitted.rest, fitted.weights);
  GroupFit fit;
  size_t num_pairs = 0;
  for (size_t k = 0; k < order.landmarks.size(); ++k) {
    const auto &given = input.landmarks[size_t(order.landmarks[k])],
               &changed = input.landmarks[size_t(order.sources[k])];
    if (!given || !changed) continue;
    ++num_pairs;
    const Eigen::RowVector3d rest = input.face.neutral.row(input.face.annotation.landmarks[size_t(order.landmarks[k])]);
    fit.given += (similarity.Apply(given->transpose()) - rest).norm();
    fit.changed += (similarity.Apply(changed->transpose()) - rest).norm();
  }
  if (num_pairs < kFewestOfGroup) return std::nullopt;
  const double scale = double(num_pairs) * SpreadOf(fitted.rest, fitted.weights);
  fit.given /= scale;
  fit.changed /= scale;
  return fit;
}

std::optional<std::string> FaultOfGroups(const FitInput& input, double max_misfit) {
  struct Candidate {
    const GroupOrder* order;
    double ratio;
  };
  std::vector<Candidate> candidates;
  for (const GroupOrder& order : GroupOrders()) {
    const auto fit = FitOfGroup(input, order);
    if (fit && fit->changed < kFarBetterOrder * fit->given && fit->changed < max_misfit)
      candidates.push_back({&order, fit->changed / fit->given});
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.ratio < b.ratio; });
  std::string faults;
  std::set<int> named;
  MeshLandmarks repaired = input.landmarks;
  for (const Candidate& candidate : candidates) {
    const std::vector<int>& group = candidate.order->landmarks;
    if (std::any_of(group.begin(), group.end(), [&](int l) { return named.count(l) > 0; })) continue;
    named.insert(group.begin(), group.end());
    for (size_t k = 0; k < group.size(); ++k)
      repaired[size_t(group[k])] = input.landmarks[size_t(candidate.order->sources[k])];
    faults += (faults.empty() ? "" : "; ") + candidate.order->fault;
  }
  // In the chaos of landmarks that are no face, some part always fits better.
  if (faults.empty() || MisfitOf(PairsOf(input, repaired, SameLandmark)) > max_misfit) return std::nullopt;
  return faults +
         ": the other order fits a face far better. Write them in iBUG order, which begins at the person's "
         "right ear, brow and eye";
}

std::vector<int> Outliers(const FitInput& input) {
  const LandmarkPairs pairs = PairsOf(input, input.landmarks, SameLandmark);
  const Eigen::VectorXd residuals = Residuals(pairs);
  std::vector<size_t> order(pairs.landmarks.size());
  std::iota(order.begin(), order.end(), size_t(0));
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t a, size_t b) { return residuals[Eigen::Index(a)] > residuals[Eigen::Index(b)]; });
  const auto residual = [&](size_t rank) { return residuals[Eigen::Index(order[rank])]; };
  for (size_t count = std::min(kMostOutliers, order.size() / kInliersOfOutlier); count > 0; --count) {
    if (residual(count - 1) < kFarOff || residual(count - 1) < kFarAbove * residual(count)) continue;
    std::vector<int> outliers;
    for (size_t rank = 0; rank < count; ++rank) outliers.push_back(pairs.landmarks[order[rank]]);
    std::sort(outliers.begin(), outliers.end());
    return outliers;
  }
  return {};
}

}  // namespace daumier::datasets
