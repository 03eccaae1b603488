#pragma once
#include "core/random.h"
#include "datasets/styles/face_shape.h"
#include "datasets/styles/style_options.h"
#include "datasets/styles/styled_lines.h"

#include <array>
#include <numeric>

namespace daumier::datasets {

/// Careful drawings follow the face, cartoons have bold smooth lines and large parts, doodles are signs, exact ones
/// have the face's own lines.
enum class DrawingCharacter { kCareful, kCartoon, kDoodle, kExact };

/// What the parts of a drawing are drawn from, and onto.
struct DrawingContext {
  const FaceShape& shape;
  const FeatureStyles& styles;
  DrawingCharacter character;
  Rng& rng;
  LineSheet& sheet;

  double unit() const { return shape.unit; }
  bool Happens(double probability) const { return rng.Uniform() < probability; }
  double Uniform(double low, double high) const { return rng.Uniform(low, high); }
  int Count(int least, int most) const { return least + static_cast<int>(rng.Below(uint64_t(most - least + 1))); }
  bool is_front() const { return shape.view == faces::DrawnView::kFront; }
};

/// An index drawn in proportion to weights; 0 if all are 0.
template <size_t N>
size_t DrawByWeight(const std::array<double, N>& weights, Rng& rng) {
  double rest = rng.Uniform() * std::accumulate(weights.begin(), weights.end(), 0.0);
  for (size_t i = 0; i < N; ++i) {
    rest -= weights[i];
    if (rest < 0) return i;
  }
  return 0;
}

}  // namespace daumier::datasets
