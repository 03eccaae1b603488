#include "reports/chosen_faces.h"

#include "core/error.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace daumier::reports {

std::vector<ChosenFace> ChooseFaces(const std::vector<int>& faces, const std::vector<double>& errors) {
  DAUMIER_CHECK(!faces.empty() && faces.size() == errors.size(), "{} faces have {} errors", faces.size(),
                errors.size());
  std::vector<size_t> order(faces.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return errors[a] < errors[b]; });
  const size_t last = order.size() - 1;
  return {{"median", faces[order[last / 2]]},
          {"95th percentile", faces[order[size_t(std::ceil(0.95 * double(last)))]]},
          {"worst", faces[order[last]]},
          {"first", faces.front()}};
}

}  // namespace daumier::reports
