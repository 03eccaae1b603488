#include "systems/sketch/gesture_predictor.h"

#include "systems/predict_each.h"
#include "systems/sketch/input_drawing.h"

namespace daumier::sketch {

datasets::Polyline PolylineOf(const render::Stroke& stroke) {
  datasets::Polyline line;
  for (const auto& point : stroke.points) line.emplace_back(point[0], point[1]);
  return line;
}

std::vector<systems::FaceResult> GesturePredictor::Predict(std::span<const systems::Input> inputs,
                                                           const Task& task) const {
  return systems::PredictEach(inputs, task, "drawings", [&](const systems::Input& input) {
    Json strokes = Json::array();
    for (const render::Stroke& stroke : DrawingOf(input).strokes) {
      const datasets::Polyline line = PolylineOf(stroke);
      if (line.size() < 2) {
        strokes.push_back(nullptr);
        continue;
      }
      const RecognisedGesture found = recogniser_.Recognise(line);
      strokes.push_back({{"gesture", NameOf(found.gesture)}, {"probability", found.probability}});
    }
    systems::FaceResult result;
    result.record = {{"strokes", strokes}};
    result.files = {{".json", result.record.dump(1) + "\n"}};
    return result;
  });
}

std::unique_ptr<systems::Predictor> OpenGesturePredictor(const std::filesystem::path& run, const Device& device,
                                                         const Json& options) {
  ParseOptions<GesturePredictOptions>(options, "options of predict");
  return std::make_unique<GesturePredictor>(OpenGestureRecogniser(run, device));
}

}  // namespace daumier::sketch
