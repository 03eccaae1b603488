#pragma once
#include "core/json.h"
#include "systems/sketch/gesture_recogniser.h"

#include <array>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace daumier::sketch {

/// Strokes whose gesture is known, and what was recognised in them.
class GestureCounts {
 public:
  /// kind: what a stroke that is no gesture is, for acceptance by kinds; may be empty.
  void Add(datasets::Gesture truth, const RecognisedGesture& found, const std::string& kind = "");

  int num_gestures() const { return num_gestures_; }
  int num_none() const { return num_none_; }
  /// Share of the strokes of the ten gestures whose likeliest gesture is right, as without rejection.
  double accuracy() const { return Share(num_right_, num_gestures_); }
  /// Share of them that are accepted, as whatever gesture.
  double accepted() const { return Share(num_accepted_, num_gestures_); }
  /// Share of them that are accepted as what they are.
  double accepted_right() const { return Share(num_accepted_right_, num_gestures_); }
  /// Share of the strokes that are no gesture that are rejected.
  double rejected() const { return Share(num_rejected_, num_none_); }

  /// accuracy, accepted, accepted_right, rejected (null without such strokes), the numbers, the confusion matrix as
  /// {TRUTH: {FOUND: number}} without zeros, and for each kind {num, accepted}.
  Json ToJson() const;

 private:
  static double Share(int part, int of) { return of > 0 ? double(part) / of : 0; }

  int num_gestures_ = 0, num_none_ = 0, num_right_ = 0, num_accepted_ = 0, num_accepted_right_ = 0, num_rejected_ = 0;
  std::array<std::array<int, kNumGestureClasses>, kNumGestureClasses> confusion_ = {};
  struct OfKind {
    int num = 0, accepted = 0;
  };
  std::map<std::string, OfKind> kinds_;
};

/// The largest threshold that accepts at least a share of gestures with these probabilities: GestureRejection::accepted
/// is the share that it does accept. @throws Error if there is none.
GestureRejection ChooseRejection(std::vector<double> probabilities, double accepted);

}  // namespace daumier::sketch
