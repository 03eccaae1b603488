#pragma once
#include <string>
#include <vector>

namespace daumier::reports {

/// A face of the databases.
struct ChosenFace {
  std::string title;
  int face = 0;
};

/// Which test faces a sheet shows: the median, where the worst 5 % begin, and the first. `errors`: of each of `faces`.
/// @throws Error if there is none, or the lengths differ.
std::vector<ChosenFace> ChooseFaces(const std::vector<int>& faces, const std::vector<double>& errors);

}  // namespace daumier::reports
