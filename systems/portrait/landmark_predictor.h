#pragma once
#include "core/device.h"
#include "core/json.h"
#include "systems/portrait/landmark_detector.h"
#include "systems/portrait/landmark_run_folder.h"
#include "systems/predictor.h"

#include <memory>
#include <string>

namespace daumier::portrait {

struct LandmarkPredictOptions {
  LandmarkDetectorOptions detector;
  std::string landmarks = {};
  std::string mask = {};

  template <class V>
  void Visit(V&& visit) {
    visit("detector", detector, Table{}, "How faces and landmarks are found.");
    visit("landmarks", landmarks, Text{},
          "File of 68 landmarks (.pts, .txt, .json) in pixels of the picture, taken in place of the network's. Of one "
          "picture.");
    visit(
        "mask", mask, Text{},
        "Grey picture of classes 0 to 7, of the size of the picture, taken in place of the network's. Of one picture.");
  }
};

/// Finds faces in pictures: boxes, landmarks, classes of pixels, states, confidence.
class LandmarkPredictor : public systems::Predictor {
 public:
  /// @throws Error as ReadLandmarks.
  LandmarkPredictor(const LandmarkNetworkOptions& network_options,
                    std::shared_ptr<const runtime::NetworkRunner> network, const LandmarkPredictOptions& options = {});

  /// One result a picture, of all faces in it: without a mesh; record {faces: DetectedFaceToJson of each, by falling
  /// confidence}; files .pts (of the first), .json (the record) and _mask.png (classes of the first); pictures `landmarks` and
  /// `parsing`. @throws Error "no face found ..." as LandmarkDetector::FindOne, or if an input is no picture.
  std::vector<systems::FaceResult> Predict(std::span<const systems::Input> inputs,
                                           const Task& task = {}) const override;

  /// The faces of a picture, with given landmarks and mask put in. @throws Error as Predict.
  std::vector<DetectedFace> Faces(const render::Image& picture) const;
  const LandmarkDetector& detector() const { return detector_; }

 private:
  systems::FaceResult ResultOf(const render::Image& picture) const;

  LandmarkPredictOptions options_;
  LandmarkDetector detector_;
  std::vector<float> given_landmarks_;  ///< 68 x 2, or empty.
};

/// A finished run or shipped weights, ready to predict. @throws Error as ReadLandmarkNetworkOptions and
/// LoadTrainingLibrary.
std::unique_ptr<systems::Predictor> OpenLandmarkPredictor(const std::filesystem::path& run, const Device& device,
                                                          const Json& options);

}  // namespace daumier::portrait
