#include "systems/portrait/landmark_files.h"

#include "core/error.h"
#include "faces/landmark_order.h"
#include "systems/portrait/picture_files.h"

#include <cmath>
#include <limits>

namespace daumier::portrait {
namespace {

double Rounded(double value) {
  return std::round(1000 * value) / 1000;
}

}  // namespace

std::vector<float> ReadKnownLandmarks(const std::filesystem::path& file) {
  const faces::OrderedLandmarks ordered = faces::OrderLandmarks(faces::ReadMarkedPoints(file));
  DAUMIER_CHECK(ordered.dimension >= 2, "{}: points have one number each, expected x and y in pixels of the picture",
                file.string());
  std::vector<float> landmarks;
  for (const std::optional<geometry::Vector3>& point : ordered.points) {
    landmarks.push_back(point ? float(point->x()) : std::numeric_limits<float>::quiet_NaN());
    landmarks.push_back(point ? float(point->y()) : std::numeric_limits<float>::quiet_NaN());
  }
  return landmarks;
}

std::vector<float> ReadLandmarks(const std::filesystem::path& file) {
  std::vector<float> landmarks = ReadKnownLandmarks(file);
  for (size_t i = 0; i < size_t(kNumLandmarks); ++i)
    DAUMIER_CHECK(std::isfinite(landmarks[2 * i]), "{}: landmark {} of {} is absent, expected all", file.string(),
                  i + 1, kNumLandmarks);
  return landmarks;
}

std::optional<std::vector<float>> LandmarksInFolder(const std::filesystem::path& folder, const std::string& name) {
  const auto file = LandmarkFileIn(folder, name);
  return file ? std::optional(ReadLandmarks(*file)) : std::nullopt;
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
    DAUMIER_CHECK(value < kNumPictureClasses, "{}: has a pixel of class {}, expected 0 to {}", file.string(), value,
                  kNumPictureClasses - 1);
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
