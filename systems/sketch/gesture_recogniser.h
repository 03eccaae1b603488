#pragma once
#include "core/array.h"
#include "core/device.h"
#include "datasets/gestures/gesture.h"
#include "runtime/network_runner.h"
#include "systems/sketch/gesture_run_folder.h"

#include <array>
#include <filesystem>
#include <memory>
#include <span>

namespace daumier::sketch {

inline constexpr int kNumGestureClasses = datasets::kNumGestures + 1;

/// What a stroke is.
struct RecognisedGesture {
  datasets::Gesture gesture = datasets::Gesture::kNone;  ///< kNone if it is rejected.
  /// Of the likeliest of the ten gestures, whether it is accepted or not.
  double probability = 0;
  datasets::Gesture likeliest = datasets::Gesture::kLine;
};

/// The softmax of scores, the last of which is that of kNone; the likeliest gesture, rejected below the threshold.
RecognisedGesture DecideGesture(std::span<const float> scores, const GestureRejection& rejection);

/// Recognises pen gestures of one stroke by the network of a run or of shipped weights [Han et al. 2017, section 5.2].
/// May be used from several threads.
class GestureRecogniser {
 public:
  static constexpr double kLeastExtent = 6;

  GestureRecogniser(const GestureDecision& decision, std::shared_ptr<const runtime::NetworkRunner> network);

  /// stroke: x right, y down, pixels of a screen. One of less than kLeastExtent both ways is a tap: kNone, probability 0.
  /// @throws Error as datasets::RasteriseGesture: fewer than two points, numbers that are not finite.
  RecognisedGesture Recognise(const datasets::Polyline& stroke) const;

 private:
  GestureDecision decision_;
  std::shared_ptr<const runtime::NetworkRunner> network_;
};

/// The recogniser of a finished run or of shipped weights, whose graph runs without LibTorch on the CPU.
/// @throws Error as ReadGestureDecision and OpenNetwork.
GestureRecogniser OpenGestureRecogniser(const std::filesystem::path& run_or_weights, const Device& device = {});

}  // namespace daumier::sketch
