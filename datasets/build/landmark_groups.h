#pragma once
#include "datasets/build/landmark_fit.h"

#include <optional>
#include <string>
#include <vector>

namespace daumier::datasets {

/// Another order of the landmarks of one part of the face.
struct GroupOrder {
  std::string fault;           ///< What the given order is, if this one is right: "the jaw (0 to 16) is reversed".
  std::vector<int> landmarks;  ///< Whose places change, and
  std::vector<int> sources;    ///< the landmark of which each takes the place.
};

/// The orders that are tried: eyes or brows exchanged, in their numbers or as mirrored, a part begun at the other end.
const std::vector<GroupOrder>& GroupOrders();

/// How an order of a group changes its misfit, all others aligned without it (geometry::AlignRobustly).
struct GroupFit {
  double given = 0;    ///< Mean distance of the group's landmarks, as a share of the template's spread.
  double changed = 0;  ///< The same in the other order.
};

/// Of the landmarks that are there with their partners. Nothing with fewer than four of them or fewer than six others.
std::optional<GroupFit> FitOfGroup(const FitInput& input, const GroupOrder& order);

/// The groups whose other order fits far better, where that and the misfit of all are at most `max_misfit`;
/// nothing where none does.
std::optional<std::string> FaultOfGroups(const FitInput& input, double max_misfit);

/// Landmarks, at most four, whose distance after the robust similarity is far above that of all others.
std::vector<int> Outliers(const FitInput& input);

}  // namespace daumier::datasets
