#pragma once
#include "rig/expression_map.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace daumier::rig {

/// Expression coefficients over time.
struct CoefficientFrames {
  Eigen::MatrixXf coefficients;      ///< N x E
  std::vector<double> seconds = {};  ///< N, ascending; empty where the file states no times.
  std::vector<std::string> warnings = {};
};

/// The coefficients of the expressions of `map` in a file, a frame a row:
/// - .npy: N x E numbers;
/// - JSON (text that begins with a bracket): a list of N lists of E numbers;
/// - a table with a header: columns in any order, named as the expressions; `time`, `t` or `seconds` are times in seconds, `frame`
///   is ignored. Expressions without a column are 0, with a warning that counts them;
/// - a table without a header: E numbers a row.
/// The constant expression may be missing in all of them; it is 1.
/// @throws Error naming the file and line or frame: empty, another number of columns (with that expected), an unknown or
/// repeated column, a cell that is no finite number, or times that do not ascend.
CoefficientFrames ReadCoefficients(const std::filesystem::path& file, const ExpressionMap& map);

/// The same of the text of a table or of JSON. `name`: what messages call it.
CoefficientFrames ParseCoefficients(std::string_view text, const std::string& name, const ExpressionMap& map);

}  // namespace daumier::rig
