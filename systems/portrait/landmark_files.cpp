#include "systems/portrait/landmark_files.h"

#include "core/error.h"
#include "faces/marked_points.h"

#include <cmath>

namespace daumier::portrait {
namespace {

double Rounded(double value) {
  return std::round(1000 * value) / 1000;
}

}  // namespace

std::vector<float> ReadLandmarks(const std::filesystem::path& file) {
  const faces::MarkedPoints marked = faces::ReadMarkedPoints(file);
  DAUMIER_CHECK(marked.points.size() == size_t(kNumLandmarks) && marked.dimension >= 2,
                "{}: has {} points of {} numbers, expected the {} landmarks of a face in a picture, x and y each",
                file.string(), marked.points.size(), marked.dimension, kNumLandmarks);
  std::vector<float> landmarks;
  for (size_t i = 0; i < marked.points.size(); ++i) {
    DAUMIER_CHECK(marked.points[i].has_value(), "{}: landmark {} of {} is absent, expected all", file.string(), i + 1,
                  kNumLandmarks);
    landmarks.push_back(float(marked.points[i]->x()));
    landmarks.push_back(float(marked.points[i]->y()));
  }
  return landmarks;
}

std::string LandmarksAsPts(std::span<const float> landmarks) {
  std::string text = fmt::format("version: 1\nn_points: {}\n{{\n", landmarks.size() / 2);
  for (size_t i = 0; i + 1 < landmarks.size(); i += 2)
    text += fmt::format("{:.3f} {:.3f}\n", landmarks[i], landmarks[i + 1]);
  return text + "}\n";
}

render::Image ReadMask(const std::filesystem::path& file, int height, int width) {
  render::Image mask = render::ReadImage(file);
  DAUMIER_CHECK(mask.channels == 1 && mask.height == height && mask.width == width,
                "{}: is {} x {} with {} channels, expected a grey picture of {} x {} like the portrait", file.string(),
                mask.height, mask.width, mask.channels, height, width);
  for (const uint8_t value : mask.pixels)
    DAUMIER_CHECK(value < kNumFaceClasses, "{}: has a pixel of class {}, expected 0 to {}", file.string(), value,
                  kNumFaceClasses - 1);
  return mask;
}

Json DetectedFaceToJson(const DetectedFace& face) {
  Json landmarks = Json::array(), confidences = Json::array();
  for (size_t i = 0; i + 1 < face.landmarks.size(); i += 2)
    landmarks.push_back({Rounded(face.landmarks[i]), Rounded(face.landmarks[i + 1])});
  for (const float confidence : face.landmark_confidences) confidences.push_back(Rounded(confidence));
  const auto state = [&](FaceState of) { return Rounded(face.states[size_t(of)]); };
  return {{"box", {Rounded(face.box.left), Rounded(face.box.top), Rounded(face.box.right), Rounded(face.box.bottom)}},
          {"confidence", Rounded(face.confidence)},
          {"landmarks", landmarks},
          {"landmark_confidences", confidences},
          {"states",
           {{"is_face", state(FaceState::kIsFace)},
            {"right_eye_closed", state(FaceState::kRightEyeClosed)},
            {"left_eye_closed", state(FaceState::kLeftEyeClosed)},
            {"mouth_open", state(FaceState::kMouthOpen)}}}};
}

}  // namespace daumier::portrait
