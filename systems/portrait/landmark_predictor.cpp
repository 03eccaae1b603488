#include "systems/portrait/landmark_predictor.h"

#include "core/error.h"
#include "render/draw.h"
#include "systems/open_network.h"
#include "systems/portrait/landmark_files.h"
#include "systems/portrait/landmark_overlay.h"
#include "systems/predict_each.h"

#include <algorithm>

namespace daumier::portrait {
namespace {

constexpr int kOverlaySide = 480;
constexpr render::Rgb kBoxColour = {255, 255, 255};

}  // namespace

LandmarkPredictor::LandmarkPredictor(const LandmarkNetworkOptions& network_options,
                                     std::shared_ptr<const runtime::NetworkRunner> network,
                                     const LandmarkPredictOptions& options)
    : options_(options), detector_(network_options, std::move(network), options.detector) {
  if (!options.landmarks.empty()) given_landmarks_ = ReadLandmarks(options.landmarks);
}

std::vector<DetectedFace> LandmarkPredictor::Faces(const render::Image& picture) const {
  if (given_landmarks_.empty()) {
    std::vector<DetectedFace> faces = detector_.FindAll(picture);
    if (faces.empty()) faces.push_back(detector_.FindOne(picture));  // Throws, with the reason.
    return faces;
  }
  return {detector_.FindGiven(picture, given_landmarks_)};
}

systems::FaceResult LandmarkPredictor::ResultOf(const render::Image& picture) const {
  const std::vector<DetectedFace> faces = Faces(picture);
  const render::Image mask = options_.mask.empty() ? faces.front().Mask(picture.height, picture.width)
                                                   : ReadMask(options_.mask, picture.height, picture.width);
  systems::FaceResult result;
  result.record["faces"] = Json::array();
  for (const DetectedFace& face : faces) result.record["faces"].push_back(DetectedFaceToJson(face));
  render::Image overlay = Fitted(picture, kOverlaySide);
  const double scale = double(overlay.width) / picture.width;
  for (const DetectedFace& face : faces) {
    DrawBox(overlay, face.box, scale, kBoxColour);
    DrawLandmarks(overlay, face.landmarks, scale);
  }
  result.pictures = {{Fitted(picture, kOverlaySide), "input"},
                     {std::move(overlay), fmt::format("landmarks, confidence {:.2f}", faces.front().confidence)},
                     {Fitted(TintedByClasses(picture, mask), kOverlaySide), "parsing"}};
  result.files = {{".pts", LandmarksAsPts(faces.front().landmarks)}, {".json", result.record.dump(1) + "\n"}};
  result.masks = {{"_mask.png", mask}};
  if (faces.size() > 1)
    result.warnings.push_back(fmt::format(
        "the picture shows {} faces; .pts and mask are those of the one of highest confidence", faces.size()));
  return result;
}

std::vector<systems::FaceResult> LandmarkPredictor::Predict(std::span<const systems::Input> inputs,
                                                            const Task& task) const {
  DAUMIER_CHECK(inputs.size() == 1 || (options_.landmarks.empty() && options_.mask.empty()),
                "landmarks and mask are given for one picture, here are {}", inputs.size());
  return systems::PredictEach(inputs, task, "pictures",
                              [&](const systems::Input& input) { return ResultOf(systems::PictureOf(input)); });
}

std::unique_ptr<systems::Predictor> OpenLandmarkPredictor(const std::filesystem::path& run, const Device& device,
                                                          const Json& options) {
  const LandmarkNetworkOptions network_options = ReadLandmarkNetworkOptions(run);
  const auto parsed = ParseOptions<LandmarkPredictOptions>(options, "options of predict");
  return std::make_unique<LandmarkPredictor>(network_options, systems::OpenNetwork(run, device), parsed);
}

}  // namespace daumier::portrait
