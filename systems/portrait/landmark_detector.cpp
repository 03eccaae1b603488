#include "systems/portrait/landmark_detector.h"

#include "core/error.h"
#include "render/heat_map_decoding.h"
#include "systems/portrait/landmark_eyes.h"
#include "systems/portrait/landmark_jaw.h"
#include "systems/portrait/landmark_views.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace daumier::portrait {
namespace {

/// The larger crop of a head: as a multiple of the face's, by which share of its side it is higher, and the border of the
/// face's crop where the larger one counts already.
constexpr double kHeadCropSide = 1.45, kHeadCropRise = 0.1, kCropBorder = 0.03;

std::vector<float> Mirrored(std::span<const float> crop, int size) {
  std::vector<float> mirrored(crop.size());
  for (size_t row = 0; row < crop.size() / size_t(size); ++row) {
    const auto from = crop.subspan(row * size_t(size), size_t(size));
    std::reverse_copy(from.begin(), from.end(), mirrored.begin() + ptrdiff_t(row * size_t(size)));
  }
  return mirrored;
}

/// Classes and states keep their places in a mirror, but the eyes' states change them.
const std::vector<int>& UnchangedClasses() {
  static const std::vector<int> order = [] {
    std::vector<int> identity(static_cast<size_t>(kNumPictureClasses));
    std::iota(identity.begin(), identity.end(), 0);
    return identity;
  }();
  return order;
}

std::array<double, kNumFaceStates> StatesOfScores(std::span<const float> scores) {
  static constexpr std::array<int, kNumFaceStates> kClasses = {2, 2, 2, 2};
  const auto probabilities = render::StateProbabilities(scores, kClasses);
  std::array<double, kNumFaceStates> states = {};
  for (size_t i = 0; i < states.size(); ++i) states[i] = probabilities[i][1];
  return states;
}

std::span<const float> RowOf(const FloatArray& array, int64_t row) {
  return {array.row(row), size_t(array.row_size())};
}

const FloatArray& OutputOf(const NamedArrays& outputs, const char* name) {
  const auto found = outputs.find(name);
  DAUMIER_CHECK(found != outputs.end(), "the network of landmarks has no output '{}'", name);
  return found->second;
}

}  // namespace

render::Image DetectedFace::Mask(int height, int width) const {
  render::Image mask(height, width, 1, uint8_t(PictureClass::kBackground));
  const int side = LabelSide(frame.size);
  const Eigen::Affine2d cells_from_picture = Eigen::Scaling(double(side) / frame.size) * frame.crop_from_picture();
  const render::ScoreGrid grid(labels, kNumPictureClasses, side, side);
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column) {
      const Eigen::Vector2d at = cells_from_picture * Eigen::Vector2d(column + 0.5, row + 0.5);
      if (at.x() < 0 || at.y() < 0 || at.x() >= side || at.y() >= side) continue;
      mask.at(row, column) = uint8_t(grid.ClassAt(at.x(), at.y()));
    }
  return mask;
}

const DetectedFace& LargestConfident(std::span<const DetectedFace> faces) {
  DAUMIER_CHECK(!faces.empty(), "there is no face to choose from");
  const auto weight = [](const DetectedFace& face) { return face.confidence * std::sqrt(face.box.area()); };
  return *std::ranges::max_element(faces, {}, weight);
}

CropFrame FrameOfLandmarks(std::span<const float> landmarks, int size) {
  const auto mean = [&](int begin, int end) {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (int i = begin; i < end; ++i) sum += Eigen::Vector2d(landmarks[2 * size_t(i)], landmarks[2 * size_t(i) + 1]);
    return Eigen::Vector2d(sum / (end - begin));
  };
  const Eigen::Vector2d eyes = mean(42, 48) - mean(36, 42);
  CropFrame frame{.side = double(size), .turn = std::atan2(eyes.y(), eyes.x()), .size = size};
  std::vector<float> turned;
  for (int i = 0; i < kNumLandmarks; ++i) {
    const Eigen::Vector2d at = frame.ToCrop({landmarks[2 * size_t(i)], landmarks[2 * size_t(i) + 1]});
    turned.push_back(float(at.x()));
    turned.push_back(float(at.y()));
  }
  const Box box = BoxOf(turned);
  frame.centre = frame.ToPicture(box.centre());
  frame.side = kCropSide * std::max(box.side(), 1.0);
  return frame;
}

LandmarkDetector::LandmarkDetector(const LandmarkNetworkOptions& network_options,
                                   std::shared_ptr<const runtime::NetworkRunner> network,
                                   const LandmarkDetectorOptions& options)
    : network_options_(network_options), network_(std::move(network)), options_(options) {}

std::vector<FoundBox> LandmarkDetector::Search(const PicturePyramid& picture, int level) const {
  const int size = network_options_.resolution;
  const std::vector<CropFrame> squares = SearchSquares(picture.height(), picture.width(), size, level);
  FloatArray crops({int64_t(squares.size()), 3, size, size});
  for (size_t i = 0; i < squares.size(); ++i)
    SampleCrop(picture, squares[i], {}, {crops.row(int64_t(i)), size_t(crops.row_size())});
  const NamedArrays outputs = network_->Run({{"pictures", std::move(crops)}});
  std::vector<FoundBox> boxes;
  for (size_t i = 0; i < squares.size(); ++i) {
    const auto of_square = BoxesOfMap(RowOf(OutputOf(outputs, "boxes"), int64_t(i)), squares[i], options_.least_score);
    boxes.insert(boxes.end(), of_square.begin(), of_square.end());
  }
  return boxes;
}

DetectedFace LandmarkDetector::Parse(const PicturePyramid& picture, const CropFrame& frame, bool mirror) const {
  const int size = frame.size, side = HeatMapSide(size), label_side = LabelSide(size);
  const std::vector<float> crop = SampleCrop(picture, frame);
  FloatArray crops({mirror ? 2 : 1, 3, size, size});
  std::ranges::copy(crop, crops.row(0));
  if (mirror) std::ranges::copy(Mirrored(crop, size), crops.row(1));
  NamedArrays outputs = network_->Run({{"pictures", std::move(crops)}});
  FloatArray maps = OutputOf(outputs, "heat_maps"), labels = OutputOf(outputs, "labels");
  const FloatArray& states = OutputOf(outputs, "states");
  DetectedFace face;
  face.frame = frame;
  face.states = StatesOfScores(RowOf(states, 0));
  if (mirror) {
    render::AverageWithMirrored({maps.row(0), size_t(maps.row_size())}, RowOf(maps, 1), side, side,
                                MirroredLandmarks());
    render::AverageWithMirrored({labels.row(0), size_t(labels.row_size())}, RowOf(labels, 1), label_side, label_side,
                                UnchangedClasses());
    std::array<double, kNumFaceStates> other = StatesOfScores(RowOf(states, 1));
    std::swap(other[size_t(FaceState::kRightEyeClosed)], other[size_t(FaceState::kLeftEyeClosed)]);
    for (size_t i = 0; i < other.size(); ++i) face.states[i] = 0.5 * (face.states[i] + other[i]);
  }
  const auto of_labels = RowOf(labels, 0);
  face.labels.assign(of_labels.begin(), of_labels.end());
  for (const render::Peak& peak :
       render::FindPeaks(RowOf(maps, 0), kNumLandmarks, side, side, {.deviation = network_options_.deviation})) {
    const Eigen::Vector2d at = frame.ToPicture(Eigen::Vector2d(peak.x, peak.y) * (double(size) / side));
    face.landmarks.push_back(float(at.x()));
    face.landmarks.push_back(float(at.y()));
    face.landmark_confidences.push_back(float(peak.confidence));
  }
  face.box = BoxOf(face.landmarks);
  return face;
}

DetectedFace LandmarkDetector::Refine(const PicturePyramid& picture, const FoundBox& candidate,
                                      std::vector<float>* unsnapped) const {
  CropFrame frame = FrameOfBox(candidate.box, network_options_.resolution);
  DetectedFace face;
  double least_state = 1;
  for (int round = 0; round < options_.rounds; ++round) {
    const bool is_last = round + 1 == options_.rounds;
    face = Parse(picture, frame, is_last && options_.mirror);
    least_state = std::min(least_state, face.states[size_t(FaceState::kIsFace)]);
    if (!is_last) frame = FrameOfLandmarks(face.landmarks, network_options_.resolution);
  }
  const double of_landmarks =
      std::accumulate(face.landmark_confidences.begin(), face.landmark_confidences.end(), 0.0) / kNumLandmarks;
  face.confidence = least_state * std::sqrt(std::min(1.0, of_landmarks));
  if (options_.even_jaw) face.landmarks = EvenJaw(face.landmarks);
  if (unsnapped != nullptr) *unsnapped = face.landmarks;
  if (options_.snap_eyes) face.landmarks = SnapEyes(face.landmarks, face.labels, face.frame);
  face.box = BoxOf(face.landmarks);
  return face;
}

std::vector<DetectedFace> LandmarkDetector::FindAll(const render::Image& picture,
                                                    std::optional<DetectedFace>* candidate) const {
  const PicturePyramid pyramid(picture);
  std::vector<DetectedFace> faces;
  if (candidate != nullptr) candidate->reset();
  for (int level = 0; level < options_.search_levels && faces.empty(); ++level) {
    std::vector<FoundBox> boxes = WithoutDoubles(Search(pyramid, level));
    if (int(boxes.size()) > options_.most_faces) boxes.resize(size_t(options_.most_faces));
    for (const FoundBox& box : boxes) {
      DetectedFace face = Refine(pyramid, box);
      if (candidate != nullptr && (!*candidate || (*candidate)->confidence < face.confidence)) *candidate = face;
      if (face.confidence >= options_.least_confidence) faces.push_back(std::move(face));
    }
  }
  std::ranges::stable_sort(faces, [](const auto& a, const auto& b) { return a.confidence > b.confidence; });
  std::vector<DetectedFace> apart;
  for (DetectedFace& face : faces)
    if (std::ranges::none_of(apart, [&](const DetectedFace& other) { return Overlap(other.box, face.box) > 0.3; }))
      apart.push_back(std::move(face));
  return apart;
}

DetectedFace LandmarkDetector::FindOne(const render::Image& picture) const {
  std::optional<DetectedFace> candidate;
  std::vector<DetectedFace> faces = FindAll(picture, &candidate);
  if (faces.empty()) {
    throw Error(fmt::format(
        "no face found in the picture of {} x {} ({}; a face needs {:.2f}). Is one face shown from the front or the "
        "side, upright, and at least a tenth of the picture wide? Otherwise give its landmarks: a file of 68 points",
        picture.width, picture.height,
        candidate ? fmt::format("the best candidate has a confidence of {:.2f}", candidate->confidence)
                  : std::string("the search has no candidate"),
        options_.least_confidence));
  }
  return LargestConfident(faces);
}

DetectedFace LandmarkDetector::FindIn(const render::Image& picture, const Box& box,
                                      std::vector<float>* unsnapped) const {
  DAUMIER_CHECK(box.area() > 0, "the box of a face is empty");
  return Refine(PicturePyramid(picture), {box, 1}, unsnapped);
}

DetectedFace LandmarkDetector::FindGiven(const render::Image& picture, std::span<const float> landmarks) const {
  DetectedFace face =
      Parse(PicturePyramid(picture), FrameOfLandmarks(landmarks, network_options_.resolution), options_.mirror);
  face.confidence = face.states[size_t(FaceState::kIsFace)];
  face.landmarks.assign(landmarks.begin(), landmarks.end());
  face.landmark_confidences.assign(size_t(kNumLandmarks), 1.0f);
  face.box = BoxOf(landmarks);
  return face;
}

render::Image LandmarkDetector::HeadMask(const render::Image& picture, const DetectedFace& face) const {
  CropFrame frame = face.frame;
  const double side = kHeadCropSide * frame.side;
  frame.centre -= kHeadCropRise * side * Eigen::Vector2d(-std::sin(frame.turn), std::cos(frame.turn));
  frame.side = side;
  const DetectedFace around = Parse(PicturePyramid(picture), frame, options_.mirror);
  const render::Image inner = face.Mask(picture.height, picture.width);
  render::Image mask = around.Mask(picture.height, picture.width);
  const double size = face.frame.size, border = kCropBorder * size;
  const Eigen::Affine2d crop_from_picture = face.frame.crop_from_picture();
  for (int row = 0; row < mask.height; ++row)
    for (int column = 0; column < mask.width; ++column) {
      const Eigen::Vector2d at = crop_from_picture * Eigen::Vector2d(column + 0.5, row + 0.5);
      if (at.minCoeff() >= border && at.maxCoeff() <= size - border) mask.at(row, column) = inner.at(row, column);
    }
  return mask;
}

}  // namespace daumier::portrait
