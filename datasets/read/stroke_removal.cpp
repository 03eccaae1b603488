#include "datasets/read/stroke_removal.h"

#include "datasets/read/stroke_arc.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace daumier::datasets {

std::vector<bool> DrawRemovedStrokes(const std::vector<render::Stroke>& strokes, int count, double order_weight,
                                     double length_weight, Rng& rng) {
  std::vector<bool> removed(strokes.size(), false);
  count = std::min(count, static_cast<int>(strokes.size()) - 1);
  if (count <= 0) return removed;
  // The greatest of log P_i + Gumbel noise are a sample without replacement [Efraimidis and Spirakis 2006]; in the log
  // domain nothing underflows.
  std::vector<double> keys(strokes.size());
  for (size_t i = 0; i < strokes.size(); ++i) {
    const double length = StrokeArc(strokes[i]).length() / render::kSketchCanvas;
    keys[i] = order_weight * static_cast<double>(i) - length_weight * length - std::log(-std::log(rng.Uniform()));
  }
  std::vector<int> order(strokes.size());
  std::iota(order.begin(), order.end(), 0);
  std::partial_sort(order.begin(), order.begin() + count, order.end(), [&](int a, int b) { return keys[a] > keys[b]; });
  for (int k = 0; k < count; ++k) removed[order[k]] = true;
  return removed;
}

}  // namespace daumier::datasets
