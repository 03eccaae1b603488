#include "systems/portrait/landmark_measurement.h"

#include "core/error.h"
#include "core/progress.h"
#include "core/stopwatch.h"
#include "render/heat_map_decoding.h"
#include "systems/portrait/landmark_eyes.h"
#include "systems/portrait/landmark_files.h"
#include "systems/portrait/landmark_views.h"
#include "systems/portrait/picture_files.h"

#include <algorithm>
#include <cmath>

namespace daumier::portrait {
namespace {

namespace fs = std::filesystem;

Box LargestSquare(const render::Image& picture) {
  const double side = std::min(picture.width, picture.height), x = 0.5 * picture.width, y = 0.5 * picture.height;
  return {x - 0.5 * side, y - 0.5 * side, x + 0.5 * side, y + 0.5 * side};
}

/// The truth in the cells of a face's labels, against the class of the highest score.
void CountLabels(const DetectedFace& face, const render::Image& mask, LabelCounts& counts) {
  const int side = LabelSide(face.frame.size);
  const render::ScoreGrid grid(face.labels, kNumPictureClasses, side, side);
  std::vector<int64_t> predicted;
  for (int row = 0; row < side; ++row)
    for (int column = 0; column < side; ++column) predicted.push_back(grid.ClassAt(column + 0.5, row + 0.5));
  counts.Add(predicted, SampleLabels(mask, face.frame, side, kUnknownLabel));
}

void CountStates(const DetectedFace& face, const std::array<float, 3>& gaps_mm, PortraitMeasurement& measured) {
  const auto count = [&](FaceState state, float gap, float closed, float open, bool is_open) {
    if (gap > closed && gap < open) return;
    const auto k = size_t(state);
    ++measured.known_states[k];
    const bool truth = is_open ? gap >= open : gap <= closed;
    measured.wrong_states[k] += (face.states[k] > 0.5) != truth;
  };
  ++measured.known_states[0];
  measured.wrong_states[0] += face.states[0] <= 0.5;
  count(FaceState::kRightEyeClosed, gaps_mm[0], kClosedEyeMm, kOpenEyeMm, false);
  count(FaceState::kLeftEyeClosed, gaps_mm[1], kClosedEyeMm, kOpenEyeMm, false);
  count(FaceState::kMouthOpen, gaps_mm[2], kClosedMouthMm, kOpenMouthMm, true);
}

/// The points whose truth is known.
std::vector<float> KnownAlone(std::span<const float> points, std::span<const float> truth) {
  std::vector<float> known;
  for (size_t i = 0; i + 1 < truth.size(); i += 2)
    if (std::isfinite(truth[i])) known.insert(known.end(), {points[i], points[i + 1]});
  return known;
}

/// The face of FindOne, or the best candidate.
std::optional<DetectedFace> ChosenFace(const LandmarkDetector& detector, const render::Image& picture) {
  std::optional<DetectedFace> candidate;
  const std::vector<DetectedFace> faces = detector.FindAll(picture, &candidate);
  if (faces.empty()) return candidate;
  return LargestConfident(faces);
}

}  // namespace

LandmarkErrors LandmarkErrorsOf(std::span<const float> points, std::span<const float> truth) {
  const auto of_landmarks = ErrorsOfLandmarks(points, truth);
  LandmarkErrors errors{.all = MeanError(of_landmarks)};
  for (size_t i = 0; i < kLandmarkParts.size(); ++i)
    errors.parts[i] = MeanError(of_landmarks, kLandmarkParts[i].begin, kLandmarkParts[i].end);
  return errors;
}

std::vector<float> MeanShapeInBox(const LandmarkSource& source, std::span<const int> samples) {
  DAUMIER_CHECK(!samples.empty(), "a mean shape needs a sample");
  std::vector<double> sums(2 * size_t(kNumLandmarks), 0);
  for (const int sample : samples) {
    const std::vector<float> landmarks = source.Get(sample).landmarks;
    const Box box = BoxOf(landmarks);
    for (size_t i = 0; i < sums.size(); i += 2) {
      sums[i] += (double(landmarks[i]) - box.left) / box.width();
      sums[i + 1] += (double(landmarks[i + 1]) - box.top) / box.height();
    }
  }
  std::vector<float> shape;
  for (const double sum : sums) shape.push_back(float(sum / double(samples.size())));
  return shape;
}

std::vector<float> ShapeInBox(std::span<const float> shape, const Box& box) {
  std::vector<float> landmarks;
  for (size_t i = 0; i + 1 < shape.size(); i += 2) {
    landmarks.push_back(float(box.left + double(shape[i]) * box.width()));
    landmarks.push_back(float(box.top + double(shape[i + 1]) * box.height()));
  }
  return landmarks;
}

PortraitMeasurement MeasurePortrait(const LandmarkDetector& detector, const LandmarkSample& sample,
                                    std::span<const float> mean_shape, LabelCounts& labels) {
  PortraitMeasurement measured{.skin_tone = sample.skin_tone};
  const Box box = BoxOf(sample.landmarks);
  std::vector<float> unsnapped;
  const DetectedFace in_box = detector.FindIn(sample.picture, box, &unsnapped);
  measured.boxed = LandmarkErrorsOf(in_box.landmarks, sample.landmarks);
  measured.unsnapped = LandmarkErrorsOf(unsnapped, sample.landmarks);
  measured.mean_shape = LandmarkErrorsOf(ShapeInBox(mean_shape, box), sample.landmarks);
  CountLabels(in_box, sample.mask, labels);
  CountStates(in_box, sample.gaps_mm, measured);
  const std::vector<DetectedFace> faces = detector.FindAll(sample.picture);
  const DetectedFace* const chosen = faces.empty() ? nullptr : &LargestConfident(faces);
  measured.found = chosen != nullptr && Overlap(chosen->box, box) > kFoundOverlap;
  measured.searched = LandmarkErrorsOf(
      measured.found ? chosen->landmarks : ShapeInBox(mean_shape, LargestSquare(sample.picture)), sample.landmarks);
  return measured;
}

std::vector<PictureMeasurement> MeasurePictures(const LandmarkDetector& detector, const fs::path& folder,
                                                const fs::path& rival, const Task& task) {
  std::vector<std::pair<fs::path, fs::path>> files;
  for (const fs::path& file : PicturesIn(folder))
    if (const auto landmarks = LandmarkFileIn(folder, file.stem().string())) files.emplace_back(file, *landmarks);
  DAUMIER_CHECK(!files.empty(), "{} holds no picture with landmarks in NAME.pts, NAME.txt or NAME.json",
                folder.string());
  Progress progress(task.Stage("Pictures"), int64_t(files.size()), "pictures");
  std::vector<PictureMeasurement> results;
  for (const auto& [file, landmarks] : files) {
    task.ThrowIfCancelled("the evaluation was stopped; nothing was written");
    PictureMeasurement result{.name = file.filename().string(), .truth = ReadKnownLandmarks(landmarks)};
    const render::Image picture = render::ReadImage(file);
    const std::vector<float>& truth = result.truth;
    const bool is_whole = std::ranges::all_of(truth, [](float value) { return std::isfinite(value); });
    const Box box = BoxOf(KnownAlone(truth, truth));
    const Stopwatch stopwatch;
    result.face = ChosenFace(detector, picture);
    result.milliseconds = 1000 * stopwatch.seconds();
    result.found = result.face && result.face->confidence >= detector.options().least_confidence &&
                   Overlap(BoxOf(KnownAlone(result.face->landmarks, truth)), box) > kFoundOverlap;
    if (result.found) result.errors = LandmarkErrorsOf(result.face->landmarks, truth);
    if (is_whole) result.boxed = LandmarkErrorsOf(detector.FindIn(picture, box).landmarks, truth);
    const fs::path other = rival / (file.stem().string() + ".pts");
    if (!rival.empty() && fs::is_regular_file(other)) {
      const std::vector<float> points = ReadLandmarks(other);
      if (Overlap(BoxOf(KnownAlone(points, truth)), box) > kFoundOverlap)
        result.rival = LandmarkErrorsOf(points, truth);
    }
    results.push_back(std::move(result));
    progress.Step();
  }
  return results;
}

std::vector<NegativeMeasurement> MeasureNegatives(const LandmarkDetector& detector, const fs::path& folder,
                                                  const Task& task) {
  const std::vector<fs::path> files = PicturesIn(folder);
  DAUMIER_CHECK(!files.empty(), "{} holds no picture", folder.string());
  Progress progress(task.Stage("Pictures without a face"), int64_t(files.size()), "pictures");
  std::vector<NegativeMeasurement> results;
  for (const fs::path& file : files) {
    task.ThrowIfCancelled("the evaluation was stopped; nothing was written");
    const std::optional<DetectedFace> face = ChosenFace(detector, render::ReadImage(file));
    results.push_back({file.filename().string(), face ? face->confidence : 0});
    progress.Step();
  }
  return results;
}

}  // namespace daumier::portrait
