#include "render/heat_map_decoding.h"

#include "core/error.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace daumier::render {
namespace {

/// p = softmax(scores), with the index of its largest.
size_t Softmax(std::span<const float> scores, std::vector<double>& p) {
  const size_t largest = size_t(std::max_element(scores.begin(), scores.end()) - scores.begin());
  p.resize(scores.size());
  double sum = 0;
  for (size_t i = 0; i < scores.size(); ++i) sum += p[i] = std::exp(double(scores[i]) - double(scores[largest]));
  for (double& value : p) value /= sum;
  return largest;
}

/// One map; window weights along an axis are reused by all cells.
Peak PeakOf(const std::vector<double>& p, size_t largest, int height, int width, const PeakOptions& options) {
  Peak peak{.x = double(largest % size_t(width)) + 0.5, .y = double(largest / size_t(width)) + 0.5};
  const double factor = -0.5 / (options.window * options.window), reach = 3 * options.window;
  std::vector<double> along_x(static_cast<size_t>(width));
  double sum = 0;
  for (int step = 0; step < options.steps; ++step) {
    const int first_row = std::max(0, int(peak.y - reach)), last_row = std::min(height - 1, int(peak.y + reach));
    const int first = std::max(0, int(peak.x - reach)), last = std::min(width - 1, int(peak.x + reach));
    for (int column = first; column <= last; ++column)
      along_x[size_t(column)] = std::exp(factor * (column + 0.5 - peak.x) * (column + 0.5 - peak.x));
    double sum_x = 0, sum_y = 0;
    sum = 0;
    for (int row = first_row; row <= last_row; ++row) {
      const double* const values = p.data() + size_t(row) * size_t(width);
      double of_row = 0, of_row_x = 0;
      for (int column = first; column <= last; ++column) {
        const double weight = values[column] * along_x[size_t(column)];
        of_row += weight;
        of_row_x += weight * (column + 0.5);
      }
      const double along_y = std::exp(factor * (row + 0.5 - peak.y) * (row + 0.5 - peak.y));
      sum += along_y * of_row;
      sum_x += along_y * of_row_x;
      sum_y += along_y * of_row * (row + 0.5);
    }
    peak.x = sum_x / sum;
    peak.y = sum_y / sum;
  }
  const double window2 = options.window * options.window, deviation2 = options.deviation * options.deviation;
  peak.confidence = std::min(1.0, sum * (window2 + deviation2) / window2);
  return peak;
}

}  // namespace

std::vector<Peak> FindPeaks(std::span<const float> scores, int num_maps, int height, int width,
                            const PeakOptions& options) {
  const size_t cells = size_t(height) * size_t(width);
  DAUMIER_CHECK(height > 0 && width > 0 && scores.size() == size_t(num_maps) * cells,
                "{} scores are no {} maps of {} x {}", scores.size(), num_maps, height, width);
  std::vector<Peak> peaks;
  std::vector<double> p;
  for (int map = 0; map < num_maps; ++map) {
    const size_t largest = Softmax(scores.subspan(size_t(map) * cells, cells), p);
    peaks.push_back(PeakOf(p, largest, height, width, options));
  }
  return peaks;
}

std::vector<std::vector<double>> StateProbabilities(std::span<const float> scores, std::span<const int> num_classes) {
  const int total = std::accumulate(num_classes.begin(), num_classes.end(), 0);
  DAUMIER_CHECK(scores.size() == size_t(total), "there are {} scores of states, expected {}", scores.size(), total);
  std::vector<std::vector<double>> states;
  size_t first = 0;
  for (const int count : num_classes) {
    Softmax(scores.subspan(first, size_t(count)), states.emplace_back());
    first += size_t(count);
  }
  return states;
}

size_t Likeliest(std::span<const double> probabilities) {
  return size_t(std::ranges::max_element(probabilities) - probabilities.begin());
}

void AverageWithMirrored(std::span<float> maps, std::span<const float> mirrored, int height, int width,
                         std::span<const int> order) {
  const size_t cells = size_t(height) * size_t(width);
  DAUMIER_CHECK(maps.size() == mirrored.size() && maps.size() == order.size() * cells,
                "{} and {} scores are no {} maps of {} x {}", maps.size(), mirrored.size(), order.size(), height,
                width);
  for (size_t map = 0; map < order.size(); ++map) {
    const float* const from = mirrored.data() + size_t(order[map]) * cells;
    float* const to = maps.data() + map * cells;
    for (int row = 0; row < height; ++row)
      for (int column = 0; column < width; ++column) {
        float& value = to[size_t(row) * size_t(width) + size_t(column)];
        value = 0.5f * (value + from[size_t(row) * size_t(width) + size_t(width - 1 - column)]);
      }
  }
}

ScoreGrid::ScoreGrid(std::span<const float> scores, int num_classes, int height, int width)
    : scores_(scores), num_classes_(num_classes), height_(height), width_(width) {
  DAUMIER_CHECK(height > 0 && width > 0 && num_classes > 0 &&
                    scores.size() == size_t(num_classes) * size_t(height) * size_t(width),
                "{} scores are no {} classes of {} x {}", scores.size(), num_classes, height, width);
  const size_t cells = size_t(height) * size_t(width);
  classes_.resize(cells);
  for (int k = 1; k < num_classes; ++k)
    for (size_t cell = 0; cell < cells; ++cell)
      if (scores[size_t(k) * cells + cell] > scores[size_t(classes_[cell]) * cells + cell]) classes_[cell] = k;
}

ScoreGrid::Place ScoreGrid::PlaceOf(double x, double y) const {
  const double column = std::clamp(x - 0.5, 0.0, double(width_ - 1)),
               row = std::clamp(y - 0.5, 0.0, double(height_ - 1));
  const int left = int(column), upper = int(row);
  return {left,
          std::min(left + 1, width_ - 1),
          upper,
          std::min(upper + 1, height_ - 1),
          float(column - left),
          float(row - upper)};
}

void ScoreGrid::At(double x, double y, std::span<float> of_classes) const {
  At(PlaceOf(x, y), of_classes);
}

void ScoreGrid::At(const Place& place, std::span<float> of_classes) const {
  const auto [left, right, upper, lower, u, v] = place;
  const size_t cells = size_t(height_) * size_t(width_);
  for (int k = 0; k < num_classes_; ++k) {
    const float* const grid = scores_.data() + size_t(k) * cells;
    const float *const above = grid + size_t(upper) * size_t(width_), *const below =
                                                                          grid + size_t(lower) * size_t(width_);
    of_classes[size_t(k)] =
        (1 - v) * ((1 - u) * above[left] + u * above[right]) + v * ((1 - u) * below[left] + u * below[right]);
  }
}

int ScoreGrid::ClassAt(double x, double y) const {
  const Place place = PlaceOf(x, y);
  // Where one class leads in all four cells, it leads between them.
  const int first = ClassOfCell(place.upper, place.left);
  if (first == ClassOfCell(place.upper, place.right) && first == ClassOfCell(place.lower, place.left) &&
      first == ClassOfCell(place.lower, place.right))
    return first;
  std::vector<float> scores(static_cast<size_t>(num_classes_));
  At(place, scores);
  return int(std::max_element(scores.begin(), scores.end()) - scores.begin());
}

std::vector<float> ScoreGrid::Margin(int of_class) const {
  DAUMIER_CHECK(of_class >= 0 && of_class < num_classes_ && num_classes_ > 1, "there is no class {} of {}", of_class,
                num_classes_);
  const size_t cells = size_t(height_) * size_t(width_);
  std::vector<float> margin(cells);
  for (size_t cell = 0; cell < cells; ++cell) {
    float other = -std::numeric_limits<float>::infinity();
    for (int k = 0; k < num_classes_; ++k)
      if (k != of_class) other = std::max(other, scores_[size_t(k) * cells + cell]);
    margin[cell] = scores_[size_t(of_class) * cells + cell] - other;
  }
  return margin;
}

}  // namespace daumier::render
