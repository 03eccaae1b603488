#pragma once
#include "cli/rig_map.h"

#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace daumier::cli {

/// Weights of the 52 targets for --animate.
struct WeightsTable {
  Eigen::MatrixXf weights;      ///< N x 52
  std::vector<double> seconds;  ///< N
  std::vector<std::string> remarks;
};

/// @throws UsageError unless the output ends in .csv, or .json of a map, and is new, this command's own or forced.
void CheckWeightsFile(const MapOutput& output, const std::vector<std::filesystem::path>& inputs);
void CheckMapFile(const MapOutput& output, const std::vector<std::filesystem::path>& inputs);

void WriteWeights(const std::filesystem::path& out, const WeightsTable& table);

/// 0, 1 / rate, 2 / rate ...
std::vector<double> EvenSeconds(Eigen::Index num_frames, double frames_per_second);

}  // namespace daumier::cli
