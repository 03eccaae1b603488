#include "systems/sketch/gesture_predictor.h"

#include "datasets/gallery/gesture_sheet.h"
#include "systems/predict_each.h"
#include "systems/sketch/input_drawing.h"

namespace daumier::sketch {

namespace {

constexpr size_t kMostStrokesShown = 40;
constexpr int kNoStrokeSide = 96;

}  // namespace

datasets::Polyline PolylineOf(const render::Stroke& stroke) {
  datasets::Polyline line;
  for (const auto& point : stroke.points) line.emplace_back(point[0], point[1]);
  return line;
}

std::vector<systems::FaceResult> GesturePredictor::Predict(std::span<const systems::Input> inputs,
                                                           const Task& task) const {
  return systems::PredictEach(inputs, task, "drawings", [&](const systems::Input& input) {
    systems::FaceResult result;
    Json strokes = Json::array();
    for (const render::Stroke& stroke : DrawingOf(input).strokes) {
      const datasets::Polyline line = PolylineOf(stroke);
      if (line.size() < 2) {
        strokes.push_back(nullptr);
        continue;
      }
      const RecognisedGesture found = recogniser_.Recognise(line);
      strokes.push_back({{"gesture", NameOf(found.gesture)}, {"probability", found.probability}});
      if (result.pictures.size() < kMostStrokesShown && datasets::BoxOf(line).sizes().maxCoeff() > 0)
        result.pictures.push_back(
            {datasets::PictureOfStroke(line),
             fmt::format("{}: {} {:.2f}", strokes.size() - 1, NameOf(found.gesture), found.probability)});
    }
    if (result.pictures.empty()) result.pictures = {{render::Image(kNoStrokeSide, kNoStrokeSide, 1, 255), "points"}};
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
