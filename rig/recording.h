#pragma once
#include "rig/weights_clip.h"

#include <string>
#include <vector>

namespace daumier::rig {

/// Weights of the 52 ARKit targets as a tracker recorded them, at times that need not be even.
struct Recording {
  std::vector<double> seconds = {};                          ///< N, ascending; the first is 0.
  std::vector<std::string> names = {};                       ///< T: ArkitNames(), in their order.
  Eigen::MatrixXf weights = {};                              ///< N x T, 0 .. 1.
  Eigen::MatrixXf head = {}, right_eye = {}, left_eye = {};  ///< As in WeightsClip; empty: none but zeros.
  std::vector<std::string> warnings = {};                    ///< What the file lacks, and what its reader changed.

  int num_frames() const { return static_cast<int>(weights.rows()); }
};

/// The longest recording that Resample takes.
inline constexpr double kLongestRecordingSeconds = 7200;

/// Even frames from the first to the last time, linear in time between the recorded ones; exact at these.
/// @throws Error if there is no frame, if frames_per_second is not in (0, 1000], or if the recording is longer than
/// kLongestRecordingSeconds.
WeightsClip Resample(const Recording& recording, double frames_per_second);

}  // namespace daumier::rig
