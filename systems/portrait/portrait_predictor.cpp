#include "systems/portrait/portrait_predictor.h"

#include "core/error.h"
#include "core/weights_folder.h"
#include "render/draw.h"
#include "systems/open_network.h"
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
  if (!options.landmark_run.empty() || !options.landmarks.empty() || !IsWeightsFolder(directory))
    return options.landmark_run;
  const std::filesystem::path shipped = WeightsNextTo(directory, kLandmarkSystem);
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
      painter_(run_.model) {
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

systems::FaceResult PortraitPredictor::PredictOne(const render::Image& picture) const {
  systems::FaceResult result;
  std::vector<float> landmarks = given_landmarks_;
  std::optional<render::Image> parsing;
  if (landmarks.empty() && landmarks_ != nullptr) {
    const std::vector<DetectedFace> faces = landmarks_->Faces(picture);
    landmarks = faces.front().landmarks;
    parsing = TintedByClasses(picture, faces.front().Mask(picture.height, picture.width));
    result.record["confidence"] = faces.front().confidence;
    if (faces.size() > 1)
      result.warnings.push_back(
          fmt::format("the picture shows {} faces, of which that of highest confidence is predicted", faces.size()));
  }
  if (landmarks.empty())
    result.warnings.push_back(
        "no landmarks were given, so that the whole picture counts as the face: landmark_run=FOLDER finds them");
  const PortraitPrediction prediction = FromLandmarks(picture, landmarks);
  const std::vector<float>& x = prediction.coefficients;
  const faces::ColouredFace face = faces::Reconstruct(run_.model, x);
  const FacePicture painted = painter_.Paint(face, x);

  result.face_template = face_template_;
  result.vertices = face.vertices.rowwise() + run_.model.centre.transpose();
  result.identity = SlotVector(x, faces::kIdentitySlot);
  result.expression = SlotVector(x, faces::kExpressionSlot);
  result.landmarks.resize(68, 3);
  for (int n = 0; n < 68; ++n)
    result.landmarks.row(n) = result.vertices.row(face_template_->annotation.landmarks[size_t(n)]);
  const std::vector<float> in_picture = MapLandmarks(painted.landmarks, prediction.map.Inverse());
  Json points = Json::array();
  for (size_t n = 0; n < 68; ++n) points.push_back({in_picture[2 * n], in_picture[2 * n + 1]});
  const PictureMap& map = prediction.map;
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
  DrawLandmarks(drawn, landmarks.empty() ? in_picture : landmarks, scale);
  result.pictures.push_back({std::move(drawn), landmarks.empty() ? "landmarks of the face" : "landmarks"});
  if (parsing) result.pictures.push_back({fitted(*parsing), "parsing"});
  result.pictures.push_back({fitted(OverlayFace(prediction.crop, painted)), "overlay"});
  return result;
}

std::vector<systems::FaceResult> PortraitPredictor::Predict(std::span<const systems::Input> inputs,
                                                            const Task& task) const {
  DAUMIER_CHECK(inputs.size() == 1 || options_.landmarks.empty(), "landmarks are given for one picture, here are {}",
                inputs.size());
  return systems::PredictEach(inputs, task, "pictures",
                              [&](const systems::Input& input) { return PredictOne(systems::PictureOf(input)); });
}

std::unique_ptr<systems::Predictor> OpenPortraitPredictor(const std::filesystem::path& run, const Device& device,
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

}  // namespace daumier::portrait
