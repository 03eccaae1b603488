#pragma once
#include "core/options.h"
#include "render/image.h"
#include "runtime/network_runner.h"
#include "systems/portrait/landmark_crop.h"
#include "systems/portrait/landmark_network_options.h"
#include "systems/portrait/landmark_sample.h"
#include "systems/portrait/landmark_search.h"

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace daumier::portrait {

struct LandmarkDetectorOptions {
  double least_confidence = 0.8;
  double least_score = 0.15;
  int most_faces = 8;
  int search_levels = 2;
  int rounds = 2;
  bool mirror = true;
  bool even_jaw = true;
  bool snap_eyes = false;

  template <class V>
  void Visit(V&& visit) {
    visit("least_confidence", least_confidence, Range{0, 1}, "Least confidence of a face; others are refused.");
    visit("least_score", least_score, Range{0, 1}, "Least score of a candidate of the search.");
    visit("most_faces", most_faces, Range{1, 1000}, "Largest number of faces of a picture, by falling confidence.");
    visit("search_levels", search_levels, Range{1, 4},
          "Scales of the search: the whole picture, then twice as large, and so on, until a scale has a face.");
    visit("rounds", rounds, Range{1, 4},
          "How often landmarks are found, each time in the upright frame of the last ones.");
    visit("mirror", mirror, Flag{}, "Average the last round with that of the mirrored crop.");
    visit("even_jaw", even_jaw, Flag{}, "Move landmarks of each half of the jaw along it to equal distances.");
    visit("snap_eyes", snap_eyes, Flag{}, "Move landmarks of eyes to the boundary of the parsed eyes.");
  }
};

/// A face in a picture.
struct DetectedFace {
  Box box;                                         ///< Of the landmarks.
  double confidence = 0;                           ///< 0..1: that it is a face.
  std::vector<float> landmarks;                    ///< 68 x 2, pixels of the picture (x0 y0 ...).
  std::vector<float> landmark_confidences;         ///< 68, 0..1; 1 for given ones.
  std::array<double, kNumFaceStates> states = {};  ///< Probabilities of FaceState.
  CropFrame frame;                                 ///< Of the last round: `labels` are scores of its cells.
  std::vector<float> labels;                       ///< 8 x n x n scores of PictureClass, n = LabelSide(frame.size).

  /// The class of every pixel of a picture of that size, grey; background outside of the crop.
  render::Image Mask(int height, int width) const;
};

/// Finds faces, their landmarks and the classes of their pixels in pictures of any size and kind. May be used from several
/// threads.
class LandmarkDetector {
 public:
  LandmarkDetector(const LandmarkNetworkOptions& network_options, std::shared_ptr<const runtime::NetworkRunner> network,
                   const LandmarkDetectorOptions& options = {});

  /// All faces of at least options.least_confidence, by falling confidence; empty if there is none.
  /// candidate: if not null, the best candidate, whether it is a face or not; absent if the search has none.
  std::vector<DetectedFace> FindAll(const render::Image& picture,
                                    std::optional<DetectedFace>* candidate = nullptr) const;
  /// LargestConfident of FindAll. @throws Error "no face found ..." with the confidence of the best candidate.
  DetectedFace FindOne(const render::Image& picture) const;
  /// The face in a box that is given; its confidence may be anything. unsnapped: if not null, the landmarks before SnapEyes.
  DetectedFace FindIn(const render::Image& picture, const Box& box, std::vector<float>* unsnapped = nullptr) const;

  /// The face of landmarks that are given (68 x 2), of whatever confidence: states and classes are those of their frame.
  DetectedFace FindGiven(const render::Image& picture, std::span<const float> landmarks) const;

  /// DetectedFace::Mask, and the classes of what is around its crop by a second, larger one: all of the head's hair, neck
  /// and ears.
  render::Image HeadMask(const render::Image& picture, const DetectedFace& face) const;

  const LandmarkDetectorOptions& options() const { return options_; }

 private:
  std::vector<FoundBox> Search(const PicturePyramid& picture, int level) const;
  DetectedFace Refine(const PicturePyramid& picture, const FoundBox& candidate,
                      std::vector<float>* unsnapped = nullptr) const;
  DetectedFace Parse(const PicturePyramid& picture, const CropFrame& frame, bool mirror) const;

  LandmarkNetworkOptions network_options_;
  std::shared_ptr<const runtime::NetworkRunner> network_;
  LandmarkDetectorOptions options_;
};

/// The face of highest confidence x the square root of its area. @throws Error if there is none.
const DetectedFace& LargestConfident(std::span<const DetectedFace> faces);

/// The upright frame of landmarks: turned so that the line of the eyes' centres is level, centred on the box of the turned
/// landmarks, kCropSide of its longer side. landmarks: 68 x 2.
CropFrame FrameOfLandmarks(std::span<const float> landmarks, int size);

}  // namespace daumier::portrait
