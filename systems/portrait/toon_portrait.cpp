#include "systems/portrait/toon_portrait.h"

#include "core/error.h"
#include "systems/portrait/landmark_bulges.h"
#include "systems/portrait/portrait_crop.h"

#include <algorithm>
#include <cmath>

namespace daumier::portrait {
namespace {

constexpr size_t kToonRightEye = 36, kToonLeftEye = 42, kToonEyeLandmarks = 6;

/// Eyes that are larger, without overlap.
std::vector<Bulge> EyeBulges(std::span<const float> landmarks, double zoom) {
  const auto point = [&](size_t n) { return Eigen::Vector2d(landmarks[2 * n], landmarks[2 * n + 1]); };
  std::vector<Bulge> bulges;
  for (const size_t eye : {kToonRightEye, kToonLeftEye}) {
    Bulge bulge{.centre = Eigen::Vector2d::Zero(), .radius = (point(eye) - point(eye + 3)).norm(), .zoom = -zoom};
    for (size_t n = 0; n < kToonEyeLandmarks; ++n) bulge.centre += point(eye + n) / double(kToonEyeLandmarks);
    bulges.push_back(bulge);
  }
  const double most = (bulges[0].centre - bulges[1].centre).norm() / 2;
  for (Bulge& bulge : bulges) bulge.radius = std::min(bulge.radius, most);
  std::erase_if(bulges, [](const Bulge& bulge) { return bulge.radius < 1; });
  return bulges;
}

/// The picture under the bulges, which only the pixels within their discs are.
render::Image Bulged(const render::Image& picture, const std::vector<Bulge>& bulges, Sampling sampling) {
  const Bulges all(bulges);
  render::Image bulged = picture;
  for (const Bulge& bulge : bulges) {
    const auto within = [](double value, int most) { return int(std::clamp(value, 0.0, double(most))); };
    const int top = within(bulge.centre.y() - bulge.radius, picture.height),
              bottom = within(bulge.centre.y() + bulge.radius + 1, picture.height),
              left = within(bulge.centre.x() - bulge.radius, picture.width),
              right = within(bulge.centre.x() + bulge.radius + 1, picture.width);
    for (int row = top; row < bottom; ++row)
      for (int column = left; column < right; ++column)
        SamplePixel(picture, all.SourceOf({column + 0.5, row + 0.5}), sampling, &bulged.at(row, column));
  }
  return bulged;
}

}  // namespace

ToonPortrait MakeToonPortrait(const render::Image& picture, std::span<const float> landmarks, const render::Image* mask,
                              const ToonPortraitOptions& options) {
  DAUMIER_CHECK(landmarks.size() == 136, "a cartoon is made by 68 landmarks, here are {} numbers", landmarks.size());
  const std::vector<Bulge> bulges = options.eyes > 0 ? EyeBulges(landmarks, options.eyes) : std::vector<Bulge>();
  ToonPortrait toon;
  toon.picture = Bulged(render::ToonPicture(picture, options.colours), bulges, Sampling::kBilinear);
  if (mask != nullptr) toon.mask = Bulged(*mask, bulges, Sampling::kNearest);
  const Bulges all(bulges);
  for (size_t n = 0; n + 1 < landmarks.size(); n += 2) {
    const Eigen::Vector2d place = all.PlaceOf({landmarks[n], landmarks[n + 1]});
    toon.landmarks.push_back(float(place.x()));
    toon.landmarks.push_back(float(place.y()));
  }
  return toon;
}

}  // namespace daumier::portrait
