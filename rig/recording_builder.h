#pragma once
#include "rig/recording.h"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace daumier::rig {

/// What turns in a recording.
enum class TurnedPart { kHead, kRightEye, kLeftEye };

/// A recording frame by frame, for the readers of clip files. Collects what its warnings state.
class RecordingBuilder {
 public:
  /// `file`: what errors call it.
  explicit RecordingBuilder(std::string file) : file_(std::move(file)) {}

  /// The target that a name means in any of its spellings; the first use of an unknown name is kept for a warning.
  std::optional<int> FindTarget(std::string_view name);
  /// A frame of zeros. It replaces one of the same time, with a warning. `place` names it in errors: "line 7".
  /// @throws Error if its time is before that of the last frame.
  void AddFrame(double seconds, const std::string& place);
  /// Of the last frame; clamped to 0 .. 1.
  void SetWeight(int target, double weight);
  /// Of the last frame, in the file's unit: pitch, yaw, roll as in WeightsClip.
  void SetTurn(TurnedPart part, const std::array<double, 3>& turn) { frames_.back().turns[size_t(part)] = turn; }
  void CountWithoutFace() { ++num_without_face_; }
  void Warn(std::string warning) { warnings_.push_back(std::move(warning)); }

  int num_frames() const { return static_cast<int>(frames_.size()); }

  /// `is_in_radians`: nothing where the file does not state it; turns up to pi are radians then, and larger ones degrees.
  /// @throws Error if there is no frame, or none of the targets.
  Recording Finish(std::optional<bool> is_in_radians);

 private:
  struct Frame {
    double seconds;
    std::vector<float> weights;
    std::array<std::array<double, 3>, 3> turns{};
  };
  Eigen::MatrixXf TurnsOf(TurnedPart part, double radians_per_unit) const;
  void WarnOfTargets();

  std::string file_;
  std::vector<Frame> frames_;
  std::vector<bool> is_found_;
  std::vector<std::string> unknown_, warnings_;
  int num_without_face_ = 0, num_at_same_time_ = 0, num_clamped_ = 0;
  double least_ = 0, greatest_ = 1;
};

/// Seconds of times in s, ms or microseconds, which the median step between them decides: frames are less than one
/// second apart. `is_milliseconds`: the file states it.
std::vector<double> SecondsOf(std::vector<double> times, bool is_milliseconds);

}  // namespace daumier::rig
