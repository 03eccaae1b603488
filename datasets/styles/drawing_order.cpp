#include "datasets/styles/drawing_order.h"

#include <algorithm>
#include <numeric>

namespace daumier::datasets {
namespace {

constexpr auto kOrders = [] {
  using enum DrawnPart;
  return std::array<std::array<DrawnPart, kNumDrawnParts>, 6>{{
      {kOutline, kEyeRight, kEyeLeft, kNose, kMouth, kBrows, kEars, kHair, kHat, kGlasses, kSkin, kBust, kPage},
      {kOutline, kEars, kHair, kBrows, kEyeRight, kEyeLeft, kGlasses, kNose, kMouth, kSkin, kHat, kBust, kPage},
      {kEyeRight, kEyeLeft, kBrows, kNose, kMouth, kOutline, kEars, kHair, kHat, kGlasses, kSkin, kBust, kPage},
      {kHair, kHat, kOutline, kEars, kBust, kBrows, kEyeRight, kEyeLeft, kNose, kMouth, kSkin, kGlasses, kPage},
      {kEyeLeft, kEyeRight, kNose, kMouth, kOutline, kHair, kEars, kBrows, kBust, kHat, kGlasses, kSkin, kPage},
      {kPage, kOutline, kNose, kEyeRight, kBrows, kEyeLeft, kMouth, kEars, kHair, kBust, kSkin, kHat, kGlasses},
  }};
}();

}  // namespace

void SortAsDrawn(LineSheet& sheet, Rng& rng) {
  const auto& order = kOrders[size_t(rng.Below(kOrders.size()))];
  std::array<double, kNumDrawnParts> ranks{};
  for (size_t i = 0; i < order.size(); ++i) ranks[size_t(order[i])] = double(i) + Deviate(0.6, rng);
  std::stable_sort(sheet.lines.begin(), sheet.lines.end(), [&](const StyledLine& a, const StyledLine& b) {
    return ranks[size_t(a.part)] < ranks[size_t(b.part)];
  });
}

}  // namespace daumier::datasets
