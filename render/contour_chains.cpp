#include "render/contour_chains.h"

#include <algorithm>
#include <deque>
#include <map>

namespace daumier::render {
namespace {

/// An end of a segment, by its number: 2 * segment for `from`, 2 * segment + 1 for `to`.
int OtherEnd(int end) {
  return end ^ 1;
}

const ContourEnd& EndOf(const std::vector<ContourSegment>& segments, int end) {
  const ContourSegment& segment = segments[size_t(end / 2)];
  return end % 2 == 0 ? segment.from : segment.to;
}

/// For each end of a segment the end of another that lies on the same mesh edge; -1 where a chain ends.
std::vector<int> Partners(const std::vector<ContourSegment>& segments) {
  std::map<std::array<int, 2>, std::vector<int>> ends_on_edge;
  const int num_ends = 2 * static_cast<int>(segments.size());
  for (int end = 0; end < num_ends; ++end) {
    const auto& edge = EndOf(segments, end).edge;
    if (edge[0] >= 0) ends_on_edge[edge].push_back(end);
  }
  std::vector<int> partners(size_t(num_ends), -1);
  for (const auto& [edge, ends] : ends_on_edge) {
    if (ends.size() != 2) continue;
    partners[size_t(ends[0])] = ends[1];
    partners[size_t(ends[1])] = ends[0];
  }
  return partners;
}

ContourChain Assembled(const std::vector<ContourSegment>& segments, const std::deque<int>& ends, bool closed) {
  ContourChain chain{geometry::Points(ends.size(), 3), Eigen::VectorXd(ends.size()), {}, closed};
  Eigen::Index row = 0;
  for (const int end : ends) {
    chain.points.row(row) = EndOf(segments, end).point;
    chain.strength[row++] = EndOf(segments, end).strength;
    chain.edges.push_back(EndOf(segments, end).edge);
  }
  return chain;
}

}  // namespace

std::vector<ContourChain> ChainContours(const std::vector<ContourSegment>& segments) {
  const std::vector<int> partners = Partners(segments);
  std::vector<bool> is_used(segments.size());
  std::vector<ContourChain> chains;
  for (size_t first = 0; first < segments.size(); ++first) {
    if (is_used[first]) continue;
    is_used[first] = true;
    const int start = 2 * static_cast<int>(first);
    std::deque<int> ends = {start, OtherEnd(start)};
    const auto is_free = [&](int end) { return end >= 0 && !is_used[size_t(end / 2)]; };
    for (int next; is_free(next = partners[size_t(ends.back())]);) {
      is_used[size_t(next / 2)] = true;
      ends.push_back(OtherEnd(next));
    }
    const bool closed = partners[size_t(ends.back())] == ends.front() && ends.size() > 2;
    for (int next; is_free(next = partners[size_t(ends.front())]);) {
      is_used[size_t(next / 2)] = true;
      ends.push_front(OtherEnd(next));
    }
    chains.push_back(Assembled(segments, ends, closed));
  }
  return chains;
}

}  // namespace daumier::render
