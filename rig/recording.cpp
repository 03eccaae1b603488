#include "rig/recording.h"

#include "core/error.h"

#include <algorithm>
#include <cmath>

namespace daumier::rig {
namespace {

/// Row r of the result is (1 - share) rows(from) + share rows(from + 1).
struct FramePlace {
  int from = 0;
  float share = 0;
};

Eigen::MatrixXf AtPlaces(const Eigen::MatrixXf& rows, const std::vector<FramePlace>& places) {
  if (rows.rows() == 0) return {};
  Eigen::MatrixXf result(Eigen::Index(places.size()), rows.cols());
  for (Eigen::Index r = 0; r < result.rows(); ++r) {
    const auto [from, share] = places[size_t(r)];
    result.row(r) = rows.row(from);
    if (share > 0) result.row(r) += share * (rows.row(from + 1) - rows.row(from));
  }
  return result;
}

}  // namespace

WeightsClip Resample(const Recording& recording, double frames_per_second) {
  DAUMIER_CHECK(recording.num_frames() > 0 && recording.seconds.size() == size_t(recording.num_frames()),
                "a recording has {} frames and {} times, expected at least one frame and a time each",
                recording.num_frames(), recording.seconds.size());
  DAUMIER_CHECK(frames_per_second > 0 && frames_per_second <= 1000, "{} frames a second, expected more than 0 to 1000",
                frames_per_second);
  const double duration = recording.seconds.back() - recording.seconds.front();
  DAUMIER_CHECK(duration <= kLongestRecordingSeconds, "the recording lasts {:.0f} s, expected at most {:.0f} s",
                duration, kLongestRecordingSeconds);
  constexpr double kRounding = 1e-6;  // Of a frame: times are decimals.
  const auto num_frames = static_cast<size_t>(std::floor(duration * frames_per_second + kRounding)) + 1;
  std::vector<FramePlace> places(num_frames);
  size_t from = 0;
  for (size_t frame = 0; frame < num_frames; ++frame) {
    const double time =
        std::min(recording.seconds.front() + double(frame) / frames_per_second, recording.seconds.back());
    while (from + 1 < recording.seconds.size() && recording.seconds[from + 1] <= time) ++from;
    places[frame].from = static_cast<int>(from);
    if (from + 1 == recording.seconds.size()) continue;
    const double step = recording.seconds[from + 1] - recording.seconds[from];
    places[frame].share = static_cast<float>((time - recording.seconds[from]) / step);
  }
  return {frames_per_second,
          recording.names,
          AtPlaces(recording.weights, places),
          AtPlaces(recording.head, places),
          AtPlaces(recording.right_eye, places),
          AtPlaces(recording.left_eye, places)};
}

}  // namespace daumier::rig
