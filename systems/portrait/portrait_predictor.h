#pragma once
#include "core/device.h"
#include "core/json.h"
#include "runtime/network_runner.h"
#include "systems/portrait/landmark_predictor.h"
#include "systems/portrait/portrait_alignment.h"
#include "systems/portrait/portrait_picture.h"
#include "systems/portrait/portrait_weights.h"
#include "systems/predictor.h"

#include <memory>
#include <string>

namespace daumier::portrait {

struct PortraitPredictOptions {
  std::string landmark_run = {};
  std::string landmarks = {};
  std::string mask = {};
  LandmarkDetectorOptions detector;
  bool fine = true;
  PortraitAlignmentOptions alignment = {.fine = {.contour = "fixed"}};  ///< As the landmark network is trained.

  template <class V>
  void Visit(V&& visit) {
    visit(
        "landmark_run", landmark_run, Text{},
        "Folder of a run that finds landmarks (daumier train, system landmarks), or of such weights, by which pictures "
        "are cropped. Empty, with shipped weights: the weights `landmarks` next to them, if they are there.");
    visit("landmarks", landmarks, Text{},
          "File of 68 landmarks (.pts, .txt, .json) in pixels of the picture, in place of a landmark run. Of one "
          "picture.");
    visit("mask", mask, Text{},
          "File of the classes of the picture's pixels (ReadHeadMask), in place of the parsing by the landmark run. Of "
          "one picture.");
    visit("detector", detector, Table{}, "How the landmark run finds faces.");
    visit("fine", fine, Flag{},
          "Whether the face is aligned to the landmarks; otherwise it is the network's coarse face.");
    visit("alignment", alignment, Table{}, "How it is aligned.");
  }
};

/// A face in a picture as a 3DMM explains it.
struct PortraitPrediction {
  PictureMap map;                   ///< From the picture to the crop.
  render::Image crop;               ///< 224 x 224, RGB.
  std::vector<float> coefficients;  ///< 239
};

/// Where a picture shows a face.
struct FoundPortrait {
  std::vector<float> landmarks;       ///< 68 x 2, pixels of the picture; empty: the picture is the crop.
  std::vector<float> confidences;     ///< 68; empty: ones.
  std::optional<render::Image> mask;  ///< PictureClass of each pixel; absent without a landmark run and a given mask.
  std::vector<std::string> warnings;
  Json record = Json::object();  ///< {confidence} of a landmark run.
};

/// What a picture shows of a face. record: {confidence, stage, landmark_error} as in results.
struct PortraitReading : FoundPortrait {
  PictureMap map;                     ///< From the picture to the crop.
  render::Image crop;                 ///< 224 x 224, RGB.
  std::vector<float> coefficients;    ///< 239
  faces::ColouredFace face;           ///< In the model's frame, not posed.
  std::optional<FacePicture> coarse;  ///< Of a fine face: the coarse one in the crop.
};

/// Faces of portraits: picture -> landmarks -> crop -> coefficients -> coarse mesh -> mesh aligned to the landmarks.
class PortraitPredictor : public systems::Predictor {
 public:
  /// landmarks: finds faces; null where landmarks are given in the options, or every picture is one crop.
  PortraitPredictor(PortraitRunFolder run, std::shared_ptr<const runtime::NetworkRunner> network,
                    std::unique_ptr<const LandmarkPredictor> landmarks, const PortraitPredictOptions& options = {});

  std::shared_ptr<const faces::FaceTemplate> face_template() const override { return face_template_; }
  /// One face a picture, the one of highest confidence: vertices in the source's frame and cm, not posed; identity and
  /// expression of the 3DMM, to which a fine face is aligned further; landmarks of the mesh; record {stage: "fine" or "coarse", coefficients:
  /// {identity, expression, albedo, light, pose}, crop: {linear, shift}, landmarks: [[x, y], ...] in pixels of the
  /// picture}, of a fine face also landmark_error: {coarse, fine}, the mean distance of its landmarks from those that it
  /// was aligned to, as a share of the distance of the outer eye corners; pictures `input`, `landmarks`, `parsing` (with
  /// a landmark run), `coarse` (of a fine face) and `overlay`. Without landmarks the picture is the crop, with a warning,
  /// and the face is coarse.
  /// @throws Error "no face found ..." as LandmarkDetector::FindOne, or if an input is no picture.
  std::vector<systems::FaceResult> Predict(std::span<const systems::Input> inputs,
                                           const Task& task = {}) const override;

  /// The parts of Predict: where a face is, what is read there, and the result of it. @throws Error as Predict.
  FoundPortrait Find(const render::Image& picture) const;
  PortraitReading ReadFound(const render::Image& picture, FoundPortrait found) const;
  PortraitReading Read(const render::Image& picture) const { return ReadFound(picture, Find(picture)); }
  systems::FaceResult ResultOf(const render::Image& picture, const PortraitReading& reading) const;

  /// landmarks: 68 x 2 in pixels of the picture; empty: the picture is the crop.
  PortraitPrediction FromLandmarks(const render::Image& picture, std::span<const float> landmarks) const;
  const PortraitRunFolder& run() const { return run_; }

 private:
  const PortraitRunFolder run_;
  const PortraitPredictOptions options_;
  const std::shared_ptr<const runtime::NetworkRunner> network_;
  const std::unique_ptr<const LandmarkPredictor> landmarks_;
  std::shared_ptr<const faces::FaceTemplate> face_template_;  ///< In the source's frame.
  const FacePainter painter_;
  std::unique_ptr<const PortraitAligner> aligner_;  ///< Null where faces are coarse.
  std::vector<float> given_landmarks_;
};

/// A finished run or shipped weights, ready to predict. @throws Error as ReadPortraitFolder, ReadLandmarkNetworkOptions
/// and LoadTrainingLibrary.
std::unique_ptr<PortraitPredictor> OpenPortraits(const std::filesystem::path& run, const Device& device,
                                                 const Json& options);
/// The same, as systems::System::open.
std::unique_ptr<systems::Predictor> OpenPortraitPredictor(const std::filesystem::path& run, const Device& device,
                                                          const Json& options);

}  // namespace daumier::portrait
