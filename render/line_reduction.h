#pragma once
#include <Eigen/Core>

#include <vector>

namespace daumier::render {

/// The indices of few points of a line, both ends among them, from whose polyline no other point is farther than
/// `tolerance` [Douglas and Peucker 1973]. None of an empty line.
std::vector<int> ReducedLine(const std::vector<Eigen::Vector2d>& line, double tolerance);

}  // namespace daumier::render
