#pragma once
#include "core/random.h"
#include "systems/portrait/landmark_augmentation.h"
#include "systems/portrait/landmark_crop.h"
#include "systems/portrait/landmark_sample.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

/// What the network sees of a sample in training: crops of faces, and scenes in which faces are small or absent.
namespace daumier::portrait {

/// Sides of the network's maps for a crop of `size` pixels.
inline int HeatMapSide(int size) {
  return size / 4;
}
inline int LabelSide(int size) {
  return size / 2;
}
inline int SearchSide(int size) {
  return size / 8;
}

/// The label of a pixel that is unknown; that of losses/label_loss.h.
inline constexpr int64_t kUnknownLabel = -100;

/// What a search map has to say (losses/box_loss.h), of one picture.
struct SearchTargets {
  std::vector<float> score, box, weight;  ///< n x n, 4 x n x n, n x n.
};

/// Boxes are in pixels of a crop of `size`. The score falls off around the centre of a box as a Gaussian, of a deviation
/// of a tenth of its longer side; the box counts in the cells whose score exceeds 0.6 and in that of its centre. Boxes
/// whose centre is outside of the crop are left out.
SearchTargets MakeSearchTargets(std::span<const Box> boxes, int size);

/// A crop and what is true in it.
struct TrainingView {
  std::vector<float> picture;          ///< 3 x size x size, 0..1.
  std::vector<float> points, weights;  ///< 68 x 2 in cells of the heat maps; 68.
  std::vector<int64_t> labels;         ///< LabelSide^2
  std::vector<int64_t> states;         ///< kNumFaceStates classes, kUnknownLabel where not known.
  SearchTargets search;
};

struct ViewOptions {
  int size = 128;
  double hidden_weight = 0.5;    ///< Of landmarks that are hidden.
  double negative_share = 0.15;  ///< Of views that show no face.
};

/// The crop of a face, or a view that is not one: clutter, shuffled blocks of the face, a part of the picture apart from the
/// face, a part of the face alone, or a face so small that only the search has to find it. Without augmentation (absent) it is the upright crop of the face.
TrainingView MakeTrainingView(const LandmarkSample& sample, const ViewOptions& options,
                              const LandmarkAugmentationOptions* augmentation, Rng& rng);

/// A scene of one or two samples in clutter, of sides of 0.12 to 0.9 of the scene each, or of none. Only picture and search of
/// the view are filled.
TrainingView MakeScene(std::span<const LandmarkSample* const> samples, const ViewOptions& options,
                       const LandmarkAugmentationOptions& augmentation, Rng& rng);

}  // namespace daumier::portrait
