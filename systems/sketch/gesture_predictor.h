#pragma once
#include "core/device.h"
#include "core/json.h"
#include "systems/predictor.h"
#include "systems/sketch/gesture_recogniser.h"

#include <filesystem>
#include <memory>

namespace daumier::sketch {

struct GesturePredictOptions {
  template <class V>
  void Visit(V&&) {}
};

/// Recognises each stroke of a drawing by itself: results without a mesh; record and file .json
/// {strokes: [{gesture, probability}]}, one a stroke, null for strokes of one point; pictures of the first strokes.
class GesturePredictor : public systems::Predictor {
 public:
  explicit GesturePredictor(GestureRecogniser recogniser) : recogniser_(std::move(recogniser)) {}

  /// Drawings, and images of line drawings (render::TraceLineDrawing). @throws Error if an input is neither.
  std::vector<systems::FaceResult> Predict(std::span<const systems::Input> inputs,
                                           const Task& task = {}) const override;

 private:
  GestureRecogniser recogniser_;
};

/// A stroke of a drawing in double precision.
datasets::Polyline PolylineOf(const render::Stroke& stroke);

std::unique_ptr<systems::Predictor> OpenGesturePredictor(const std::filesystem::path& run, const Device& device,
                                                         const Json& options);

}  // namespace daumier::sketch
