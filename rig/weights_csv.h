#pragma once
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

namespace daumier::rig {

/// Weights of the 52 targets over time as a table that ParseClipCsv reads: comments, a header `time` and ArkitNames(), a row a
/// frame with seconds and weights to five digits.
/// weights: N x 52; seconds: N; remarks: a comment line each. The first line is kWeightsCsvMark.
/// @throws Error if the shapes disagree or there is no frame.
std::string WeightsCsv(const Eigen::MatrixXf& weights, const std::vector<double>& seconds,
                       const std::vector<std::string>& remarks);

/// The first line of such a table, by which a command recognises its own.
inline constexpr std::string_view kWeightsCsvMark = "# Weights of 52 targets, written by daumier rig";

}  // namespace daumier::rig
