#pragma once
#include "core/task.h"
#include "systems/portrait/landmark_detector.h"
#include "systems/portrait/landmark_errors.h"

#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

/// Measurements of a detector on portraits and on pictures of other origin.
namespace daumier::portrait {

/// Normalised errors of one face (NormalisedError), of landmarks whose truth is known; NaN of a part without one.
struct LandmarkErrors {
  double all = 0;
  std::array<double, kLandmarkParts.size()> parts = {};
};
LandmarkErrors LandmarkErrorsOf(std::span<const float> points, std::span<const float> truth);

/// The mean of the landmarks of some samples, each in the unit square of its own box: 68 x 2.
std::vector<float> MeanShapeInBox(const LandmarkSource& source, std::span<const int> samples);
/// These landmarks in a box.
std::vector<float> ShapeInBox(std::span<const float> shape, const Box& box);

/// A detector on one portrait.
struct PortraitMeasurement {
  LandmarkErrors searched, boxed, unsnapped, mean_shape;  ///< Face searched; true box given; that without SnapEyes.
  bool found = false;  ///< The searched face overlaps the true box by more than kFoundOverlap.
  std::array<int64_t, kNumFaceStates> known_states = {}, wrong_states = {};
  int skin_tone = 0;
};
inline constexpr double kFoundOverlap = 0.3;

/// A face that is not found counts as `mean_shape` in the largest square of the picture. Pixels of the mask are added to
/// `labels`, of the face in the true box.
PortraitMeasurement MeasurePortrait(const LandmarkDetector& detector, const LandmarkSample& sample,
                                    std::span<const float> mean_shape, LabelCounts& labels);

/// A picture with given landmarks.
struct PictureMeasurement {
  std::string name;
  std::vector<float> truth = {};          ///< 68 x 2, NaN where it is not known.
  std::optional<DetectedFace> face = {};  ///< The chosen one (LandmarkDetector::FindOne), of whatever confidence.
  bool found = false;  ///< Confident enough; its box of the known landmarks overlaps theirs by more than kFoundOverlap.
  std::optional<LandmarkErrors> errors = {};  ///< Of the face that was found.
  std::optional<LandmarkErrors> boxed = {};   ///< With the true box given; absent unless all of the truth is known.
  std::optional<LandmarkErrors> rival = {};   ///< Of another program, where it found the face.
  double milliseconds = 0;                    ///< Of FindOne, without reading the file.
};

/// Pictures of a folder that have landmarks, or some of them, in a file of their name (LandmarkFileIn), in the order of
/// PicturesIn. rival: folder of NAME.pts, or empty. @throws Error if there is no such picture.
std::vector<PictureMeasurement> MeasurePictures(const LandmarkDetector& detector, const std::filesystem::path& folder,
                                                const std::filesystem::path& rival, const Task& task = {});

/// A picture without a face: the confidence of its best candidate, 0 if there is none.
struct NegativeMeasurement {
  std::string name;
  double confidence = 0;
};
std::vector<NegativeMeasurement> MeasureNegatives(const LandmarkDetector& detector, const std::filesystem::path& folder,
                                                  const Task& task = {});

}  // namespace daumier::portrait
