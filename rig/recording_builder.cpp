#include "rig/recording_builder.h"

#include "core/error.h"
#include "rig/arkit_names.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

namespace daumier::rig {
namespace {

constexpr size_t kMostListed = 12;  ///< Names in a message.

std::string Listed(const std::vector<std::string>& names) {
  const size_t num_listed = std::min(names.size(), kMostListed);
  const std::string text = fmt::format("{}", fmt::join(std::span(names).first(num_listed), ", "));
  return num_listed == names.size() ? text : fmt::format("{} and {} more", text, names.size() - num_listed);
}

const char* VerbFor(size_t count) {
  return count == 1 ? "is" : "are";
}

}  // namespace

std::optional<int> RecordingBuilder::FindTarget(std::string_view name) {
  const std::optional<int> target = FindArkitName(name);
  if (target) {
    is_found_.resize(kNumArkitNames);
    is_found_[size_t(*target)] = true;
  } else if (std::ranges::find(unknown_, name) == unknown_.end()) {
    unknown_.emplace_back(name);
  }
  return target;
}

void RecordingBuilder::AddFrame(double seconds, const std::string& place) {
  if (!frames_.empty()) {
    const double last = frames_.back().seconds;
    DAUMIER_CHECK(seconds >= last,
                  "{}: {}: its time is {:.4f} s before that of the frame before (expected ascending times). Sort the "
                  "rows by time, or remove this one",
                  file_, place, last - seconds);
    if (seconds == last) {
      frames_.pop_back();
      ++num_at_same_time_;
    }
  }
  frames_.push_back({seconds, std::vector<float>(kNumArkitNames, 0.0f)});
}

void RecordingBuilder::SetWeight(int target, double weight) {
  if (weight < 0 || weight > 1) ++num_clamped_;
  least_ = std::min(least_, weight);
  greatest_ = std::max(greatest_, weight);
  frames_.back().weights[size_t(target)] = static_cast<float>(std::clamp(weight, 0.0, 1.0));
}

Eigen::MatrixXf RecordingBuilder::TurnsOf(TurnedPart part, double radians_per_unit) const {
  Eigen::MatrixXf turns(num_frames(), 3);
  for (Eigen::Index i = 0; i < turns.rows(); ++i)
    for (int axis = 0; axis < 3; ++axis)
      turns(i, axis) = static_cast<float>(radians_per_unit * frames_[size_t(i)].turns[size_t(part)][size_t(axis)]);
  return turns.isZero(0) ? Eigen::MatrixXf() : turns;
}

void RecordingBuilder::WarnOfTargets() {
  std::vector<std::string> missing;
  for (int i = 0; i < kNumArkitNames; ++i)
    if (!is_found_[size_t(i)]) missing.emplace_back(ArkitNames()[size_t(i)]);
  if (!missing.empty())
    Warn(fmt::format("{} of {} targets {} missing and 0: {}", missing.size(), kNumArkitNames, VerbFor(missing.size()),
                     Listed(missing)));
  if (!unknown_.empty())
    Warn(fmt::format("{} unknown name{} {} ignored: {}", unknown_.size(), unknown_.size() == 1 ? "" : "s",
                     VerbFor(unknown_.size()), Listed(unknown_)));
}

Recording RecordingBuilder::Finish(std::optional<bool> is_in_radians) {
  DAUMIER_CHECK(!is_found_.empty(),
                "{}: contains no weight of an ARKit target (expected names such as jawOpen, JawOpen or eyeBlink_L{})",
                file_, unknown_.empty() ? "" : "; found " + Listed(unknown_));
  DAUMIER_CHECK(!frames_.empty(), "{}: contains no frame with a face", file_);
  WarnOfTargets();
  double largest = 0;
  for (const Frame& frame : frames_)
    for (const auto& turn : frame.turns)
      for (const double angle : turn) largest = std::max(largest, std::abs(angle));
  const bool radians = is_in_radians.value_or(largest <= std::numbers::pi);
  if (!is_in_radians && largest > 0)
    Warn(fmt::format("turns of head and eyes are read as {}: the largest is {:.3g}, and the format states no unit",
                     radians ? "radians" : "degrees", largest));
  if (num_clamped_ > 0)
    Warn(fmt::format("{} of {} weights {} clamped to 0 .. 1: they range from {:.4g} to {:.4g}", num_clamped_,
                     frames_.size() * size_t(kNumArkitNames), VerbFor(size_t(num_clamped_)), least_, greatest_));
  if (num_without_face_ > 0)
    Warn(fmt::format("{} frame{} without a face {} skipped", num_without_face_, num_without_face_ == 1 ? "" : "s",
                     VerbFor(size_t(num_without_face_))));
  if (num_at_same_time_ > 0)
    Warn(fmt::format("{} frame{} {} replaced by the next of the same time", num_at_same_time_,
                     num_at_same_time_ == 1 ? "" : "s", VerbFor(size_t(num_at_same_time_))));

  Recording recording;
  recording.names.assign(ArkitNames().begin(), ArkitNames().end());
  recording.weights.resize(num_frames(), kNumArkitNames);
  for (int i = 0; i < num_frames(); ++i) {
    recording.seconds.push_back(frames_[size_t(i)].seconds - frames_.front().seconds);
    recording.weights.row(i) = Eigen::Map<const Eigen::RowVectorXf>(frames_[size_t(i)].weights.data(), kNumArkitNames);
  }
  const double radians_per_unit = radians ? 1.0 : std::numbers::pi / 180.0;
  recording.head = TurnsOf(TurnedPart::kHead, radians_per_unit);
  recording.right_eye = TurnsOf(TurnedPart::kRightEye, radians_per_unit);
  recording.left_eye = TurnsOf(TurnedPart::kLeftEye, radians_per_unit);
  recording.warnings = std::move(warnings_);
  return recording;
}

std::vector<double> SecondsOf(std::vector<double> times, bool is_milliseconds) {
  double seconds_per_unit = is_milliseconds ? 1e-3 : 1;
  if (!is_milliseconds && times.size() > 1) {
    std::vector<double> steps;
    for (size_t i = 1; i < times.size(); ++i) steps.push_back(times[i] - times[i - 1]);
    const auto middle = steps.begin() + ptrdiff_t(steps.size() / 2);
    std::nth_element(steps.begin(), middle, steps.end());
    if (*middle > 1) seconds_per_unit = *middle > 1000 ? 1e-6 : 1e-3;
  }
  for (double& time : times) time *= seconds_per_unit;
  return times;
}

}  // namespace daumier::rig
