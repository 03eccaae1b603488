#include "systems/portrait/landmark_views.h"

#include "core/error.h"
#include "systems/portrait/landmark_bulges.h"
#include "systems/portrait/landmark_clutter.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace daumier::portrait {
namespace {

constexpr double kRadians = std::numbers::pi / 180;

Outside DrawOutside(Rng& rng) {
  if (rng.Below(2) == 0) return {};
  return {.continued = false, .colour = {float(rng.Uniform()), float(rng.Uniform()), float(rng.Uniform())}};
}

CropFrame DrawFrame(const Box& box, int size, const LandmarkAugmentationOptions& options, Rng& rng) {
  CropFrame frame = FrameOfBox(box, size);
  const double strength = options.strength, side = frame.side;
  frame.side *= std::exp(strength * rng.Uniform(-options.scale, options.scale));
  frame.centre += side * strength * options.shift * Eigen::Vector2d(rng.Uniform(-1, 1), rng.Uniform(-1, 1));
  // The product of two uniform numbers: most turns are small.
  frame.turn = kRadians * strength * options.rotation_degrees * rng.Uniform(-1, 1) * rng.Uniform(0.2, 1);
  if (rng.Uniform() < options.upside_down * strength) frame.turn = rng.Uniform(-std::numbers::pi, std::numbers::pi);
  frame.mirrored = rng.Uniform() < options.flip;
  frame.stretch = strength * rng.Uniform(-options.stretch, options.stretch);
  return frame;
}

/// Landmarks in the crop, pixels, 68 x 2; those of a mirrored crop in the order of the mirror.
std::vector<float> PointsInCrop(const LandmarkSample& sample, const CropFrame& frame) {
  std::vector<float> points(2 * size_t(kNumLandmarks));
  for (int i = 0; i < kNumLandmarks; ++i) {
    const auto from = size_t(frame.mirrored ? MirroredLandmarks()[size_t(i)] : i);
    const Eigen::Vector2d at = frame.ToCrop({sample.landmarks[2 * from], sample.landmarks[2 * from + 1]});
    points[2 * size_t(i)] = float(at.x());
    points[2 * size_t(i) + 1] = float(at.y());
  }
  return points;
}

void MovePoints(std::vector<float>& points, const Bulges& bulges) {
  for (size_t i = 0; i < points.size(); i += 2) {
    const Eigen::Vector2d place = bulges.PlaceOf({points[i], points[i + 1]});
    points[i] = float(place.x());
    points[i + 1] = float(place.y());
  }
}

/// Empty where nothing moves.
std::vector<float> FieldOf(const Bulges& bulges, int size, int cells) {
  return bulges.empty() ? std::vector<float>() : bulges.Field(size, cells);
}

int64_t StateOf(float gap_mm, float closed_mm, float open_mm, bool open_is_one) {
  if (gap_mm <= closed_mm) return open_is_one ? 0 : 1;
  return gap_mm >= open_mm ? (open_is_one ? 1 : 0) : kUnknownLabel;
}

std::vector<int64_t> StatesOf(const LandmarkSample& sample, bool mirrored) {
  const auto eye = [&](size_t i) { return StateOf(sample.gaps_mm[i], kClosedEyeMm, kOpenEyeMm, false); };
  return {1, eye(mirrored ? 1 : 0), eye(mirrored ? 0 : 1),
          StateOf(sample.gaps_mm[2], kClosedMouthMm, kOpenMouthMm, true)};
}

/// Without points and states, labels unknown.
TrainingView EmptyView(int size) {
  TrainingView view;
  view.picture.resize(3 * size_t(size) * size_t(size));
  view.points.resize(2 * size_t(kNumLandmarks), 0);
  view.weights.resize(size_t(kNumLandmarks), 0);
  view.labels.resize(size_t(LabelSide(size)) * size_t(LabelSide(size)), kUnknownLabel);
  view.states = {0, kUnknownLabel, kUnknownLabel, kUnknownLabel};
  return view;
}

/// A square of the picture that overlaps the face by little; nothing if the face fills the picture.
std::optional<CropFrame> FrameApart(const LandmarkSample& sample, int size, Rng& rng) {
  const Box face = BoxOf(sample.landmarks);
  for (int trial = 0; trial < 8; ++trial) {
    const double side = rng.Uniform(0.25, 0.8) * sample.picture.width;
    const CropFrame frame{.centre = {rng.Uniform(0, sample.picture.width), rng.Uniform(0, sample.picture.height)},
                          .side = side,
                          .size = size};
    const Box box{frame.centre.x() - 0.5 * side, frame.centre.y() - 0.5 * side, frame.centre.x() + 0.5 * side,
                  frame.centre.y() + 0.5 * side};
    const double width = std::min(face.right, box.right) - std::max(face.left, box.left),
                 height = std::min(face.bottom, box.bottom) - std::max(face.top, box.top);
    if (width <= 0 || height <= 0 || width * height < 0.15 * face.area()) return frame;
  }
  return {};
}

/// A crop of the face that is far too close or too far away.
CropFrame FrameOfWrongSize(const LandmarkSample& sample, int size, bool is_close, Rng& rng) {
  CropFrame frame = FrameOfBox(BoxOf(sample.landmarks), size);
  const auto landmark = size_t(rng.Below(uint64_t(kNumLandmarks)));
  if (is_close) frame.centre = {sample.landmarks[2 * landmark], sample.landmarks[2 * landmark + 1]};
  const double side = frame.side;
  frame.side *= is_close ? rng.Uniform(0.15, 0.4) : rng.Uniform(2.5, 5);
  if (!is_close) frame.centre += 0.3 * (frame.side - side) * Eigen::Vector2d(rng.Uniform(-1, 1), rng.Uniform(-1, 1));
  return frame;
}

TrainingView NegativeView(const LandmarkSample& sample, const ViewOptions& options, Rng& rng) {
  const int size = options.size;
  TrainingView view = EmptyView(size);
  view.search = MakeSearchTargets({}, size);
  const uint64_t kind = rng.Below(6);
  std::optional<CropFrame> frame;
  if (kind < 2) frame = FrameApart(sample, size, rng);
  if (kind > 3) frame = FrameOfWrongSize(sample, size, kind == 4, rng);
  if (frame) {
    SampleCrop(PicturePyramid(sample.picture), *frame, DrawOutside(rng), view.picture);
    view.labels = SampleLabels(sample.mask, *frame, LabelSide(size), kUnknownLabel);
    const Box box = BoxOf(PointsInCrop(sample, *frame));
    if (kind == 5) view.search = MakeSearchTargets({&box, 1}, size);
  } else if (kind == 2) {
    SampleCrop(PicturePyramid(sample.picture), FrameOfBox(BoxOf(sample.landmarks), size), DrawOutside(rng),
               view.picture);
    ShuffleBlocks(view.picture, size, rng);
  } else {
    DrawClutter(view.picture, size, rng);
    std::ranges::fill(view.labels, int64_t(PictureClass::kBackground));
  }
  return view;
}

/// With a margin of a quarter of its longer side: what of a picture is shown where there are several.
Box Enlarged(const Box& box) {
  const double margin = 0.25 * box.side();
  return {box.left - margin, box.top - margin, box.right + margin, box.bottom + margin};
}

}  // namespace

SearchTargets MakeSearchTargets(std::span<const Box> boxes, int size) {
  constexpr double kCounts = 0.6;
  const int side = SearchSide(size);
  const double cell = double(size) / side;
  const auto cells = size_t(side) * size_t(side);
  SearchTargets targets{std::vector<float>(cells, 0), std::vector<float>(4 * cells, 0), std::vector<float>(cells, 0)};
  for (const Box& box : boxes) {
    const Eigen::Vector2d centre = box.centre() / cell;
    if (centre.x() < 0 || centre.y() < 0 || centre.x() >= side || centre.y() >= side) continue;
    const double deviation = std::max(0.5, 0.1 * box.side() / cell);
    const int centre_row = int(centre.y()), centre_column = int(centre.x());
    for (int row = 0; row < side; ++row)
      for (int column = 0; column < side; ++column) {
        const size_t at = size_t(row) * size_t(side) + size_t(column);
        const bool is_centre = row == centre_row && column == centre_column;
        const double dx = column - centre_column, dy = row - centre_row;
        const auto score = is_centre ? 1.0f : float(std::exp(-0.5 * (dx * dx + dy * dy) / (deviation * deviation)));
        if (score < targets.score[at]) continue;
        targets.score[at] = score;
        if (score < kCounts) continue;
        targets.weight[at] = 1;
        const std::array<double, 4> numbers = {centre.x() - (column + 0.5), centre.y() - (row + 0.5),
                                               std::log(box.width() / cell), std::log(box.height() / cell)};
        for (size_t k = 0; k < 4; ++k) targets.box[k * cells + at] = float(numbers[k]);
      }
  }
  return targets;
}

TrainingView MakeTrainingView(const LandmarkSample& sample, const ViewOptions& options,
                              const LandmarkAugmentationOptions* augmentation, Rng& rng) {
  const int size = options.size;
  if (augmentation != nullptr && rng.Uniform() < options.negative_share) {
    TrainingView view = NegativeView(sample, options, rng);
    ChangeColours(view.picture, size, *augmentation, rng);
    return view;
  }
  TrainingView view = EmptyView(size);
  const Box box = BoxOf(sample.landmarks);
  const CropFrame frame = augmentation != nullptr ? DrawFrame(box, size, *augmentation, rng) : FrameOfBox(box, size);
  view.points = PointsInCrop(sample, frame);
  Bulges bulges;
  if (augmentation != nullptr && rng.Uniform() < augmentation->bulges * augmentation->strength) {
    bulges = DrawBulges(view.points, augmentation->strength, rng);
    MovePoints(view.points, bulges);
  }
  SampleCrop(PicturePyramid(sample.picture), frame, augmentation != nullptr ? DrawOutside(rng) : Outside(),
             view.picture, FieldOf(bulges, size, size));
  view.labels =
      SampleLabels(sample.mask, frame, LabelSide(size), kUnknownLabel, FieldOf(bulges, size, LabelSide(size)));
  if (augmentation != nullptr && rng.Uniform() < augmentation->teeth * augmentation->strength) {
    std::vector<uint8_t> mouth;
    for (const int64_t label : view.labels) mouth.push_back(label == int64_t(PictureClass::kMouth));
    PaintTeeth(view.picture, size, mouth, LabelSide(size), rng);
  }
  view.states = StatesOf(sample, frame.mirrored);
  const Box in_crop = BoxOf(view.points);
  view.search = MakeSearchTargets({&in_crop, 1}, size);
  std::vector<uint8_t> covered(view.labels.size(), 0);
  if (augmentation != nullptr && rng.Uniform() < augmentation->occluder * augmentation->strength) {
    DrawOccluders(view.picture, size, covered, LabelSide(size), rng);
    for (size_t i = 0; i < covered.size(); ++i)
      if (covered[i] != 0 && view.labels[i] != kUnknownLabel) view.labels[i] = int64_t(PictureClass::kBackground);
  }
  if (augmentation != nullptr) ChangeColours(view.picture, size, *augmentation, rng);
  const int side = HeatMapSide(size), label_side = LabelSide(size);
  for (int i = 0; i < kNumLandmarks; ++i) {
    const auto at = size_t(i), from = size_t(frame.mirrored ? MirroredLandmarks()[at] : i);
    float &x = view.points[2 * at], &y = view.points[2 * at + 1];
    const int column = int(std::floor(x * label_side / size)), row = int(std::floor(y * label_side / size));
    const bool is_inside = column >= 0 && row >= 0 && column < label_side && row < label_side;
    const bool is_covered = is_inside && covered[size_t(row) * size_t(label_side) + size_t(column)] != 0;
    const bool is_hidden = sample.visibility[from] == 0 || is_covered;
    view.weights[at] = !is_inside ? 0.0f : is_hidden ? float(options.hidden_weight) : 1.0f;
    x *= float(side) / float(size);
    y *= float(side) / float(size);
  }
  return view;
}

TrainingView MakeScene(std::span<const LandmarkSample* const> samples, const ViewOptions& options,
                       const LandmarkAugmentationOptions& augmentation, Rng& rng) {
  const int size = options.size;
  const size_t count = size_t(size) * size_t(size);
  TrainingView view = EmptyView(size);
  DrawClutter(view.picture, size, rng);
  std::vector<Box> boxes;
  std::vector<float> layer(3 * count);
  for (const LandmarkSample* sample : samples) {
    const Box box = BoxOf(sample->landmarks);
    const double share = 0.12 * std::pow(0.9 / 0.12, samples.size() > 1 ? 0.6 * rng.Uniform() : rng.Uniform());
    CropFrame frame{.side = box.side() / share, .mirrored = rng.Below(2) == 0, .size = size};
    frame.turn = kRadians * augmentation.rotation_degrees * rng.Uniform(-1, 1) * rng.Uniform(0.2, 1);
    frame.stretch = rng.Uniform(-augmentation.stretch, augmentation.stretch);
    // The face lies wholly in the scene where it fits, apart from the faces before it.
    const double room = std::max(0.0, 0.5 - 0.5 * share);
    std::optional<Box> placed;
    Bulges bulges;
    for (int trial = 0; trial < 6 && !placed; ++trial) {
      const Eigen::Vector2d shift(rng.Uniform(-room, room), rng.Uniform(-room, room));
      frame.centre = box.centre() - frame.picture_from_crop() * (shift * size);
      std::vector<float> points = PointsInCrop(*sample, frame);
      bulges = Bulges();
      if (rng.Uniform() < augmentation.bulges * augmentation.strength) {
        bulges = DrawBulges(points, augmentation.strength, rng);
        MovePoints(points, bulges);
      }
      const Box candidate = BoxOf(points);
      if (std::ranges::all_of(boxes,
                              [&](const Box& other) { return Overlap(Enlarged(other), Enlarged(candidate)) == 0; }))
        placed = candidate;
    }
    if (!placed) continue;
    boxes.push_back(*placed);
    SampleCrop(PicturePyramid(sample->picture), frame, {}, layer, FieldOf(bulges, size, size));
    const bool is_alone = samples.size() == 1, fills = is_alone && rng.Below(2) == 0;
    const Box window = Enlarged(*placed);
    for (int row = 0; row < size; ++row)
      for (int column = 0; column < size; ++column) {
        const Eigen::Vector2d at = frame.ToPicture({column + 0.5, row + 0.5});
        const bool is_inside =
            at.x() >= 0 && at.y() >= 0 && at.x() < sample->picture.width && at.y() < sample->picture.height;
        if (!fills && !is_inside) continue;
        if (!is_alone && (column < window.left || column > window.right || row < window.top || row > window.bottom))
          continue;
        const size_t pixel = size_t(row) * size_t(size) + size_t(column);
        for (size_t k = 0; k < 3; ++k) view.picture[k * count + pixel] = layer[k * count + pixel];
      }
  }
  ChangeColours(view.picture, size, augmentation, rng);
  view.search = MakeSearchTargets(boxes, size);
  return view;
}

}  // namespace daumier::portrait
