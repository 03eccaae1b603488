#pragma once
#include "faces/appearance/head_soup.h"
#include "tests/support/synthetic_face.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <map>
#include <utility>

/// What holds for every piece that is added to a head.
namespace daumier::testing {

inline faces::HeadSoup EmptySoup() {
  return {geometry::Points(0, 3), Eigen::MatrixXf(0, 3)};
}

/// Every edge between two places is used as often in one direction as in the other: equal positions are one place.
inline void ExpectClosedSoup(const faces::PortraitHead& head) {
  std::map<std::array<double, 3>, int> places;
  std::vector<int> place_of(size_t(head.vertices.rows()));
  for (int v = 0; v < head.vertices.rows(); ++v) {
    std::array<double, 3> key;
    for (int k = 0; k < 3; ++k) key[size_t(k)] = std::round(head.vertices(v, k) * 1e7);
    place_of[size_t(v)] = places.emplace(key, int(places.size())).first->second;
  }
  std::map<std::pair<int, int>, int> edges;
  for (const auto& t : head.triangles.rowwise()) {
    const std::array<int, 3> c = {place_of[size_t(t[0])], place_of[size_t(t[1])], place_of[size_t(t[2])]};
    if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0]) continue;
    for (size_t k = 0; k < 3; ++k) ++edges[{c[k], c[(k + 1) % 3]}];
  }
  EXPECT_FALSE(edges.empty());
  for (const auto& [edge, count] : edges) {
    const auto other = edges.find({edge.second, edge.first});
    ASSERT_TRUE(other != edges.end() && other->second == count) << "open";
  }
}

/// cm^3 within closed surfaces that are wound outwards.
inline double VolumeOf(const faces::PortraitHead& head) {
  double sum = 0;
  for (const auto& t : head.triangles.rowwise()) {
    const geometry::Vector3 a = head.vertices.row(t[0]), b = head.vertices.row(t[1]), c = head.vertices.row(t[2]);
    sum += a.dot(b.cross(c)) / 6;
  }
  return sum;
}

}  // namespace daumier::testing
