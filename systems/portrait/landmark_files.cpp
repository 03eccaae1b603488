#include "systems/portrait/landmark_files.h"

#include "core/error.h"
#include "faces/landmark_order.h"
#include "systems/portrait/picture_files.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace daumier::portrait {
namespace {

double Rounded(double value) {
  return std::round(1000 * value) / 1000;
}

constexpr uint8_t kWhite = 255, kMostBlack = 24;
constexpr double kMostBetween = 0.05;  // Share of pixels.
constexpr double kMostStretch = 0.01;  // Between the shapes of a mask and of its picture.

/// One channel of a picture whose channels are equal; the picture itself if they are not.
render::Image GreyOf(const render::Image& picture) {
  if (picture.channels == 1) return picture;
  render::Image grey(picture.height, picture.width, 1);
  for (size_t i = 0; i < grey.pixels.size(); ++i) {
    const uint8_t* rgb = &picture.pixels[3 * i];
    if (rgb[0] != rgb[1] || rgb[0] != rgb[2]) return picture;
    grey.pixels[i] = rgb[0];
  }
  return grey;
}

render::Image NearestPixels(const render::Image& mask, int height, int width) {
  render::Image scaled(height, width, 1);
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column)
      scaled.at(row, column) =
          mask.at(int((row + 0.5) * mask.height / height), int((column + 0.5) * mask.width / width));
  return scaled;
}

/// But for few pixels at borders, as softened edges and JPEG have them.
bool IsBlackAndWhite(const render::Image& mask) {
  const auto is_between = [](uint8_t value) { return value > kMostBlack && value < kWhite - kMostBlack; };
  const auto num_between = std::ranges::count_if(mask.pixels, is_between);
  const auto num_white = std::ranges::count_if(mask.pixels, [](uint8_t value) { return value >= kWhite - kMostBlack; });
  return num_white > 0 && double(num_between) < kMostBetween * double(mask.pixels.size());
}

/// What is parsed within the white, where background becomes skin.
render::Image Within(const render::Image& white, const std::optional<render::Image>& parsed) {
  render::Image classes(white.height, white.width, 1, uint8_t(PictureClass::kBackground));
  for (size_t i = 0; i < classes.pixels.size(); ++i) {
    if (white.pixels[i] <= kWhite / 2) continue;
    classes.pixels[i] = parsed ? parsed->pixels[i] : uint8_t(PictureClass::kBackground);
    if (classes.pixels[i] == uint8_t(PictureClass::kBackground)) classes.pixels[i] = uint8_t(PictureClass::kSkin);
  }
  return classes;
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

std::string CheckLandmarks(const std::filesystem::path& file, std::span<const float> landmarks, int height, int width) {
  const double reach = std::max(height, width);
  const auto point = [&](size_t n) { return Eigen::Vector2d(landmarks[2 * n], landmarks[2 * n + 1]); };
  int num_outside = 0;
  for (size_t n = 0; n < size_t(kNumLandmarks); ++n) {
    const Eigen::Vector2d p = point(n), inside = p.cwiseMax(0).cwiseMin(Eigen::Vector2d(width, height));
    const double outside = (p - inside).cwiseAbs().maxCoeff();
    DAUMIER_CHECK(
        outside <= reach,
        "{}: landmark {} is at ({:.4g}, {:.4g}), outside of the picture of {} x {} pixels. Expected pixels of this "
        "picture",
        file.string(), n + 1, p.x(), p.y(), width, height);
    num_outside += outside > 0 ? 1 : 0;
  }
  const Eigen::Vector2d right = (point(36) + point(39)) / 2, left = (point(42) + point(45)) / 2;
  const Eigen::Vector2d across = left - right, down = point(8) - (right + left) / 2;
  DAUMIER_CHECK(
      across.x() * down.y() - across.y() * down.x() > 0,
      "{}: the landmarks are those of a mirrored face: landmarks 37 to 42 are the face's own right eye, which is on "
      "the left of an upright picture",
      file.string());
  return num_outside == 0 ? ""
                          : fmt::format("{}: {} of {} landmarks are outside of the picture", file.string(), num_outside,
                                        kNumLandmarks);
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

render::Image ReadHeadMask(const std::filesystem::path& file, int height, int width,
                           const std::optional<render::Image>& parsed) {
  render::Image mask = GreyOf(render::ReadImage(file));
  DAUMIER_CHECK(mask.channels == 1,
                "{}: is a picture in colours, expected a grey one of the classes 0 to {}, or black "
                "and white",
                file.string(), kNumPictureClasses - 1);
  DAUMIER_CHECK(std::abs(double(mask.width) * height / (double(mask.height) * width) - 1) < kMostStretch,
                "{}: is {} x {}, and the portrait {} x {}: expected the same shape", file.string(), mask.width,
                mask.height, width, height);
  if (mask.height != height || mask.width != width) mask = NearestPixels(mask, height, width);
  if (IsBlackAndWhite(mask)) return Within(mask, parsed);
  for (const uint8_t value : mask.pixels)
    DAUMIER_CHECK(
        value < kNumPictureClasses,
        "{}: has a pixel of the value {}, expected classes 0 to {} (docs/formats.md), or black and white. Threshold "
        "it (ImageMagick: convert IN -threshold 50% OUT)",
        file.string(), value, kNumPictureClasses - 1);
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
