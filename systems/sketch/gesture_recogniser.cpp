#include "systems/sketch/gesture_recogniser.h"

#include "core/error.h"
#include "systems/open_network.h"

#include <algorithm>
#include <cmath>

namespace daumier::sketch {

namespace {

bool IsTap(const datasets::Polyline& stroke) {
  const bool is_stroke =
      stroke.size() >= 2 && std::ranges::all_of(stroke, [](const auto& point) { return point.allFinite(); });
  return is_stroke && datasets::BoxOf(stroke).sizes().maxCoeff() < GestureRecogniser::kLeastExtent;
}

}  // namespace

RecognisedGesture DecideGesture(std::span<const float> scores, const GestureRejection& rejection) {
  DAUMIER_CHECK(scores.size() == size_t{kNumGestureClasses}, "{} scores of a gesture, expected {}", scores.size(),
                kNumGestureClasses);
  const double largest = *std::ranges::max_element(scores);
  double sum = 0;
  for (const float score : scores) sum += std::exp(score - largest);
  const auto likeliest = std::max_element(scores.begin(), scores.end() - 1);
  RecognisedGesture found{.probability = std::exp(*likeliest - largest) / sum,
                          .likeliest = datasets::Gesture(likeliest - scores.begin())};
  if (found.probability >= rejection.threshold) found.gesture = found.likeliest;
  return found;
}

GestureRecogniser::GestureRecogniser(const GestureDecision& decision,
                                     std::shared_ptr<const runtime::NetworkRunner> network)
    : decision_(decision), network_(std::move(network)) {}

RecognisedGesture GestureRecogniser::Recognise(const datasets::Polyline& stroke) const {
  if (IsTap(stroke)) return {};
  const datasets::GestureRaster raster = decision_.network_options.raster();
  FloatArray picture({1, 1, raster.side, raster.side});
  datasets::RasteriseGesture(stroke, raster, picture.values);
  const NamedArrays outputs = network_->Run({{"pictures", std::move(picture)}});
  const auto scores = outputs.find("scores");
  DAUMIER_CHECK(scores != outputs.end(), "the network of gestures has no output 'scores'");
  return DecideGesture(scores->second.values, decision_.rejection);
}

GestureRecogniser OpenGestureRecogniser(const std::filesystem::path& run_or_weights, const Device& device) {
  return {ReadGestureDecision(run_or_weights), systems::OpenNetwork(run_or_weights, device)};
}

}  // namespace daumier::sketch
