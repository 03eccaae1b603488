#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

namespace daumier {

/// At most `count` elements, evenly spaced in their order and including the first: element i of n chosen from N is
/// number floor(i N / n).
template <class T>
std::vector<T> EvenlySpaced(const std::vector<T>& things, int64_t count) {
  const int64_t total = int64_t(things.size()), num_chosen = std::min(count, total);
  std::vector<T> chosen;
  for (int64_t i = 0; i < num_chosen; ++i) chosen.push_back(things[size_t(i * total / num_chosen)]);
  return chosen;
}

}  // namespace daumier
