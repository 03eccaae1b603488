#include "systems/portrait/portrait_predictor.h"

#include "core/error.h"
#include "core/weights_folder.h"
#include "render/draw.h"
#include "systems/open_network.h"
#include "systems/portrait/landmark_errors.h"
#include "systems/portrait/landmark_files.h"
#include "systems/portrait/landmark_overlay.h"
#include "systems/predict_each.h"

#include <utility>

namespace daumier::portrait {
namespace {

constexpr int kPortraitPictureSide = 360;

/// The template where the source has it.
std::shared_ptr<const faces::FaceTemplate> TemplateInSourceFrame(const faces::MorphableModel& model) {
  auto face_template = std::make_shared<faces::FaceTemplate>(model.face_template);
  face_template->neutral.rowwise() += model.centre.transpose();
  return face_template;
}

Json Numbers(std::span<const float> coefficients, const faces::CoefficientSlot& slot) {
  const auto begin = coefficients.begin() + slot.first;
  return std::vector<float>(begin, begin + slot.count);
}

/// The run or weights that find landmarks; empty: none do.
std::filesystem::path LandmarkFolder(const std::filesystem::path& directory, const PortraitPredictOptions& options) {
  if (!options.landmark_run.empty() || !IsWeightsFolder(directory)) return options.landmark_run;
  const std::filesystem::path shipped = WeightsNextTo(directory, kLandmarkSystem);
  CheckNotDamaged(shipped);
  return IsWeightsFolder(shipped) ? shipped : std::filesystem::path();
}

Eigen::VectorXf SlotVector(std::span<const float> coefficients, const faces::CoefficientSlot& slot) {
  return Eigen::Map<const Eigen::VectorXf>(coefficients.data() + slot.first, slot.count);
}

}  // namespace

PortraitPredictor::PortraitPredictor(PortraitRunFolder run, std::shared_ptr<const runtime::NetworkRunner> network,
                                     std::unique_ptr<const LandmarkPredictor> landmarks,
                                     const PortraitPredictOptions& options)
    : run_(std::move(run)),
      options_(options),
      network_(std::move(network)),
      landmarks_(std::move(landmarks)),
      face_template_(TemplateInSourceFrame(run_.model)),
      painter_(run_.model),
      aligner_(options.fine && (landmarks_ != nullptr || !options.landmarks.empty())
                   ? std::make_unique<const PortraitAligner>(run_.model, options.alignment)
                   : nullptr) {
  if (!options.landmarks.empty()) given_landmarks_ = ReadLandmarks(options.landmarks);
}

PortraitPrediction PortraitPredictor::FromLandmarks(const render::Image& picture,
                                                    std::span<const float> landmarks) const {
  PortraitPrediction prediction;
  const PortraitPictureOptions& pictures = run_.options.pictures;
  prediction.map = landmarks.empty() || pictures.crop == "none" ? CropOfWhole(picture.height, picture.width)
                                                                : CropOfLandmarks(landmarks, pictures.size);
  prediction.crop = render::ToRgb(WarpPicture(picture, prediction.map));
  const int resolution = run_.options.network.resolution;
  NamedArrays inputs;
  inputs["crop"] = FloatArray({1, 3, resolution, resolution}, NetworkPicture(prediction.crop, resolution));
  const NamedArrays outputs = network_->Run(inputs);
  const auto found = outputs.find("coefficients");
  DAUMIER_CHECK(found != outputs.end() && found->second.values.size() == size_t(faces::kNumCoefficients),
                "the network of {} returns no {} coefficients", run_.directory.string(), faces::kNumCoefficients);
  prediction.coefficients = found->second.values;
  return prediction;
}

FoundPortrait PortraitPredictor::Find(const render::Image& picture) const {
  FoundPortrait found;
  found.landmarks = given_landmarks_;
  if (!given_landmarks_.empty()) {
    std::string warning = CheckLandmarks(options_.landmarks, given_landmarks_, picture.height, picture.width);
    if (!warning.empty()) found.warnings.push_back(std::move(warning));
  }
  if (landmarks_ != nullptr) {
    const LandmarkDetector& detector = landmarks_->detector();
    const std::vector<DetectedFace> faces = given_landmarks_.empty()
                                                ? landmarks_->Faces(picture)
                                                : std::vector{detector.FindGiven(picture, given_landmarks_)};
    found.landmarks = faces.front().landmarks;
    found.confidences = faces.front().landmark_confidences;
    found.mask = detector.HeadMask(picture, faces.front());
    found.record["confidence"] = faces.front().confidence;
    if (faces.size() > 1)
      found.warnings.push_back(
          fmt::format("the picture shows {} faces, of which that of highest confidence is predicted", faces.size()));
  }
  if (!options_.mask.empty()) found.mask = ReadHeadMask(options_.mask, picture.height, picture.width, found.mask);
  if (found.landmarks.empty())
    found.warnings.push_back(
        "no landmarks were given, so that the whole picture counts as the face: landmark_run=FOLDER finds them");
  return found;
}

PortraitReading PortraitPredictor::ReadFound(const render::Image& picture, FoundPortrait found) const {
  PortraitReading reading;
  static_cast<FoundPortrait&>(reading) = std::move(found);
  PortraitPrediction prediction = FromLandmarks(picture, reading.landmarks);
  reading.map = prediction.map;
  reading.crop = std::move(prediction.crop);
  reading.coefficients = std::move(prediction.coefficients);
  reading.face = faces::Reconstruct(run_.model, reading.coefficients);
  reading.record["stage"] = "coarse";
  if (aligner_ == nullptr) return reading;
  reading.coarse = painter_.Paint(reading.face, reading.coefficients);
  const std::vector<float> in_crop = MapLandmarks(reading.landmarks, reading.map);
  AlignedPortrait aligned = aligner_->Align(reading.coefficients, in_crop, reading.confidences);
  reading.coefficients = std::move(aligned.coefficients);
  reading.face.vertices = std::move(aligned.vertices);
  reading.record["stage"] = "fine";
  reading.record["landmark_error"] = {{"coarse", NormalisedError(aligned.coarse, in_crop)},
                                      {"fine", NormalisedError(aligned.landmarks, in_crop)}};
  return reading;
}

systems::FaceResult PortraitPredictor::ResultOf(const render::Image& picture, const PortraitReading& reading) const {
  systems::FaceResult result;
  const std::vector<float>& x = reading.coefficients;
  const FacePicture painted = painter_.Paint(reading.face, x);
  result.warnings = reading.warnings;
  result.record = reading.record;
  result.face_template = face_template_;
  result.vertices = reading.face.vertices.rowwise() + run_.model.centre.transpose();
  result.identity = SlotVector(x, faces::kIdentitySlot);
  result.expression = SlotVector(x, faces::kExpressionSlot);
  result.landmarks.resize(68, 3);
  for (int n = 0; n < 68; ++n)
    result.landmarks.row(n) = result.vertices.row(face_template_->annotation.landmarks[size_t(n)]);
  const std::vector<float> in_picture = MapLandmarks(painted.landmarks, reading.map.Inverse());
  Json points = Json::array();
  for (size_t n = 0; n < 68; ++n) points.push_back({in_picture[2 * n], in_picture[2 * n + 1]});
  const PictureMap& map = reading.map;
  result.record["coefficients"] = {{"identity", Numbers(x, faces::kIdentitySlot)},
                                   {"expression", Numbers(x, faces::kExpressionSlot)},
                                   {"albedo", Numbers(x, faces::kAlbedoSlot)},
                                   {"light", Numbers(x, faces::kLightSlot)},
                                   {"pose", Numbers(x, faces::kPoseSlot)}};
  result.record["crop"] = {{"linear", {{map.linear(0, 0), map.linear(0, 1)}, {map.linear(1, 0), map.linear(1, 1)}}},
                           {"shift", {map.shift.x(), map.shift.y()}}};
  result.record["landmarks"] = std::move(points);

  const auto fitted = [](const render::Image& image) { return Fitted(image, kPortraitPictureSide); };
  result.pictures.push_back({fitted(picture), "input"});
  render::Image drawn = fitted(picture);
  const double scale = double(drawn.width) / picture.width;
  const std::vector<float>& landmarks = reading.landmarks;
  DrawLandmarks(drawn, landmarks.empty() ? in_picture : landmarks, scale);
  result.pictures.push_back({std::move(drawn), landmarks.empty() ? "landmarks of the face" : "landmarks"});
  if (reading.mask) result.pictures.push_back({fitted(TintedByClasses(picture, *reading.mask)), "parsing"});
  if (reading.coarse) result.pictures.push_back({fitted(OverlayFace(reading.crop, *reading.coarse)), "coarse"});
  result.pictures.push_back({fitted(OverlayFace(reading.crop, painted)), "overlay"});
  return result;
}

std::vector<systems::FaceResult> PortraitPredictor::Predict(std::span<const systems::Input> inputs,
                                                            const Task& task) const {
  DAUMIER_CHECK(inputs.size() == 1 || (options_.landmarks.empty() && options_.mask.empty()),
                "landmarks and mask are given for one picture, here are {}", inputs.size());
  return systems::PredictEach(inputs, task, "pictures", [&](const systems::Input& input) {
    const render::Image& picture = systems::PictureOf(input);
    return ResultOf(picture, Read(picture));
  });
}

std::unique_ptr<PortraitPredictor> OpenPortraits(const std::filesystem::path& run, const Device& device,
                                                 const Json& options) {
  PortraitRunFolder folder = ReadPortraitFolder(run);
  const auto parsed = ParseOptions<PortraitPredictOptions>(options, "options of predict");
  std::unique_ptr<const LandmarkPredictor> landmarks;
  if (const std::filesystem::path of_landmarks = LandmarkFolder(run, parsed); !of_landmarks.empty()) {
    landmarks = std::make_unique<LandmarkPredictor>(ReadLandmarkNetworkOptions(of_landmarks),
                                                    systems::OpenNetwork(of_landmarks, device),
                                                    LandmarkPredictOptions{.detector = parsed.detector});
  }
  return std::make_unique<PortraitPredictor>(std::move(folder), systems::OpenNetwork(run, device), std::move(landmarks),
                                             parsed);
}

std::unique_ptr<systems::Predictor> OpenPortraitPredictor(const std::filesystem::path& run, const Device& device,
                                                          const Json& options) {
  return OpenPortraits(run, device, options);
}

}  // namespace daumier::portrait
