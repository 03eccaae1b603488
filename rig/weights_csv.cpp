#include "rig/weights_csv.h"

#include "core/error.h"
#include "rig/arkit_names.h"

#include <fmt/ranges.h>

#include <algorithm>

namespace daumier::rig {

std::string WeightsCsv(const Eigen::MatrixXf& weights, const std::vector<double>& seconds,
                       const std::vector<std::string>& remarks) {
  DAUMIER_CHECK(weights.rows() > 0 && weights.cols() == kNumArkitNames && std::ssize(seconds) == weights.rows(),
                "weights are {} x {}, times {}; expected N x {} with N times", weights.rows(), weights.cols(),
                seconds.size(), kNumArkitNames);
  std::string text(kWeightsCsvMark);
  text += '\n';
  for (std::string remark : remarks) {
    std::ranges::replace(remark, '\n', ' ');
    text += "# " + remark + '\n';
  }
  text += fmt::format("time,{}\n", fmt::join(ArkitNames(), ","));
  for (Eigen::Index frame = 0; frame < weights.rows(); ++frame) {
    text += fmt::format("{:.9f}", seconds[size_t(frame)]);
    for (Eigen::Index t = 0; t < weights.cols(); ++t) text += fmt::format(",{:.5g}", std::max(0.0f, weights(frame, t)));
    text += '\n';
  }
  return text;
}

}  // namespace daumier::rig
