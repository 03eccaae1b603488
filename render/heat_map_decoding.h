#pragma once
#include <cstddef>
#include <span>
#include <vector>

/// What the numbers of a heat-map network (models/heat_map_unet.h) mean, without LibTorch.
namespace daumier::render {

/// Where a point is in a map, and how sure that is.
struct Peak {
  double x = 0, y = 0;    ///< Cells; the centre of cell (0, 0) is at (0.5, 0.5).
  double confidence = 0;  ///< 0..1
};

struct PeakOptions {
  double deviation = 1.2;  ///< Of the Gaussians that the network was trained with, cells.
  double window = 2.0;     ///< Deviation of the Gaussian window around a peak, cells.
  int steps = 8;           ///< Of the mean shift.
};

/// The peaks of maps of scores, row-major, `num_maps` x `height` x `width`. Each map's softmax p is a distribution over
/// the cells. From its largest cell a mean shift [Comaniciu and Meer 2002] follows: x becomes the mean of the cells'
/// centres weighted by p and a Gaussian window around x. Of a Gaussian of `deviation` the limit is its centre, whatever
/// the window: sub-cell positions have no bias to the cells' centres. A second mode outside of the window has no
/// influence.
/// confidence: the windowed sum of p over that of such a Gaussian, at most 1.
/// @throws Error if the number of scores is another.
std::vector<Peak> FindPeaks(std::span<const float> scores, int num_maps, int height, int width,
                            const PeakOptions& options = {});

/// Probabilities of the classes of each state: a softmax of each group of `num_classes` neighbours in `scores`.
/// @throws Error if the number of scores is not their sum.
std::vector<std::vector<double>> StateProbabilities(std::span<const float> scores, std::span<const int> num_classes);

/// The class of the greatest probability, the first of equals; 0 of none.
size_t Likeliest(std::span<const double> probabilities);

/// The mean of maps and of those that the network made of the mirror image: map m of the mirror image shows, mirrored,
/// what map order[m] shows. Both are num_maps x height x width. Scores are averaged as they are.
/// @throws Error if sizes disagree.
void AverageWithMirrored(std::span<float> maps, std::span<const float> mirrored, int height, int width,
                         std::span<const int> order);

/// Scores of classes on a grid, looked up between the cells' centres; views memory of the caller.
class ScoreGrid {
 public:
  /// scores: num_classes x height x width, row-major.
  ScoreGrid(std::span<const float> scores, int num_classes, int height, int width);

  int num_classes() const { return num_classes_; }
  int height() const { return height_; }
  int width() const { return width_; }
  /// Scores at a point, in cells as Peak has them; bilinear, the border cells continue beyond the border.
  void At(double x, double y, std::span<float> of_classes) const;
  /// The class of the highest score there; the first of equals.
  int ClassAt(double x, double y) const;
  /// One field a grid: by how much the score of a class exceeds the highest other one, height x width. Positive within
  /// the class, zero on its boundary.
  std::vector<float> Margin(int of_class) const;

 private:
  /// The cells that a point lies between, and its shares of the second column and row.
  struct Place {
    int left, right, upper, lower;
    float u, v;
  };
  Place PlaceOf(double x, double y) const;
  void At(const Place& place, std::span<float> of_classes) const;
  int ClassOfCell(int row, int column) const { return classes_[size_t(row) * size_t(width_) + size_t(column)]; }

  std::span<const float> scores_;
  int num_classes_, height_, width_;
  std::vector<int> classes_;  ///< Of each cell, that of the highest score.
};

}  // namespace daumier::render
