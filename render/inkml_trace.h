#pragma once
#include <Eigen/Core>

#include <string_view>
#include <vector>

namespace daumier::render {

/// Where X and Y are among the values of a point of an InkML trace, and in which sense they grow.
struct InkMlChannels {
  int x = 0, y = 1;
  double x_sign = 1.0, y_sign = 1.0;  ///< -1: the channel's orientation is "-ve".
};

/// The points of the content of an InkML <trace> [W3C 2011, 3.2]: points between commas, values with or without white
/// space between them, each a number, a hexadecimal one (#1F), T, F, ? (not recorded) or * (as the last); ! makes the
/// channel's values explicit from there on, ' first differences, " second differences. Points without X or Y are left
/// out.
/// @throws Error that quotes what is malformed, or if a coordinate is not finite as a float.
std::vector<Eigen::Vector2d> ParseInkMlTrace(std::string_view text, const InkMlChannels& channels = {});

}  // namespace daumier::render
