#pragma once
#include <string>
#include <vector>

namespace daumier::reports {

/// A face of the databases.
struct ChosenFace {
  std::string title;
  int face = 0;
};

/// The faces that a sheet shows: of the median error, where the worst 5 % begin, of the largest error, and the first.
/// `errors`: one a face, finite. @throws Error if there is none, or the lengths differ.
std::vector<ChosenFace> ChooseFaces(const std::vector<int>& faces, const std::vector<double>& errors);

}  // namespace daumier::reports
