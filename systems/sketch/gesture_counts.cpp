#include "systems/sketch/gesture_counts.h"

#include "core/error.h"

#include <algorithm>
#include <cmath>

namespace daumier::sketch {

void GestureCounts::Add(datasets::Gesture truth, const RecognisedGesture& found, const std::string& kind) {
  ++confusion_[size_t(truth)][size_t(found.gesture)];
  const bool is_accepted = found.gesture != datasets::Gesture::kNone;
  if (truth != datasets::Gesture::kNone) {
    ++num_gestures_;
    num_right_ += found.likeliest == truth;
    num_accepted_ += is_accepted;
    num_accepted_right_ += found.gesture == truth;
    return;
  }
  ++num_none_;
  num_rejected_ += !is_accepted;
  if (kind.empty()) return;
  ++kinds_[kind].num;
  kinds_[kind].accepted += is_accepted;
}

Json GestureCounts::ToJson() const {
  Json confusion = Json::object(), kinds = Json::object();
  for (size_t truth = 0; truth < confusion_.size(); ++truth)
    for (size_t found = 0; found < confusion_.size(); ++found)
      if (const int count = confusion_[truth][found]; count > 0)
        confusion[NameOf(datasets::Gesture(truth))][NameOf(datasets::Gesture(found))] = count;
  for (const auto& [kind, of_kind] : kinds_) kinds[kind] = {{"num", of_kind.num}, {"accepted", of_kind.accepted}};
  const auto share = [](double value, int of) { return of > 0 ? Json(value) : Json(); };
  return {{"num_gestures", num_gestures_},
          {"num_none", num_none_},
          {"accuracy", share(accuracy(), num_gestures_)},
          {"accepted", share(accepted(), num_gestures_)},
          {"accepted_right", share(accepted_right(), num_gestures_)},
          {"rejected", share(rejected(), num_none_)},
          {"confusion", confusion},
          {"none_by_kind", kinds}};
}

GestureRejection ChooseRejection(std::vector<double> probabilities, double accepted) {
  DAUMIER_CHECK(!probabilities.empty(), "a threshold of rejection without validation strokes of gestures");
  std::ranges::sort(probabilities, std::greater<>());
  const auto count =
      std::clamp<size_t>(size_t(std::ceil(accepted * double(probabilities.size()) - 1e-9)), 1, probabilities.size());
  const double threshold = probabilities[count - 1];
  const auto reached = std::ranges::count_if(probabilities, [&](double p) { return p >= threshold; });
  return {.threshold = threshold, .accepted = double(reached) / double(probabilities.size())};
}

}  // namespace daumier::sketch
