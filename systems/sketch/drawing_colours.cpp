#include "systems/sketch/drawing_colours.h"

#include "faces/annotation.h"
#include "render/filled_area.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace daumier::sketch {
namespace {

constexpr int kLeastChroma = 26;  // Of 255.
constexpr double kLeastSkinShare = 0.2, kLeastPartShare = 0.1;
constexpr size_t kLeastPixels = 6;
constexpr float kLeastDifference = 0.08F;

using RegionOutline = std::vector<Eigen::Vector2d>;

RegionOutline RegionOutlineOf(const render::Stroke& stroke) {
  RegionOutline outline;
  for (const auto& [x, y] : stroke.points) outline.emplace_back(x, y);
  return outline;
}

std::vector<RegionOutline> CurvesOfKind(const std::vector<render::Stroke>& curves, std::string_view kind) {
  const std::vector<std::string>& kinds = faces::CurveKinds();
  const auto number = std::ranges::find(kinds, kind) - kinds.begin();
  std::vector<RegionOutline> found;
  for (const render::Stroke& curve : curves)
    if (curve.kind == number && curve.points.size() > 1) found.push_back(RegionOutlineOf(curve));
  return found;
}

Eigen::Vector2d MiddleOf(const RegionOutline& outline) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& point : outline) sum += point;
  return sum / double(outline.size());
}

/// Each upper line with the lower one that is nearest to it, as one outline.
std::vector<RegionOutline> Joined(const std::vector<RegionOutline>& upper, const std::vector<RegionOutline>& lower) {
  std::vector<RegionOutline> joined;
  if (lower.empty()) return joined;
  for (const RegionOutline& above : upper) {
    RegionOutline outline = above;
    RegionOutline below = *std::ranges::min_element(
        lower, {}, [&](const RegionOutline& line) { return (MiddleOf(line) - MiddleOf(above)).norm(); });
    if ((below.front() - above.back()).norm() > (below.back() - above.back()).norm()) std::ranges::reverse(below);
    outline.insert(outline.end(), below.begin(), below.end());
    joined.push_back(std::move(outline));
  }
  return joined;
}

/// Marks the pixels within outlines by 1, or removes their mark.
class Region {
 public:
  Region(int height, int width) : mask_(height, width, 1, 0) {}
  Region& With(const std::vector<RegionOutline>& outlines) { return Fill(outlines, 1); }
  Region& Without(const std::vector<RegionOutline>& outlines) { return Fill(outlines, 0); }
  const render::Image& mask() const { return mask_; }

 private:
  Region& Fill(const std::vector<RegionOutline>& outlines, uint8_t value) {
    for (const RegionOutline& outline : outlines) render::FillArea({.outlines = {outline}}, {}, value, mask_);
    return *this;
  }

  render::Image mask_;
};

uint8_t MedianOf(std::vector<uint8_t>& values) {
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::ranges::nth_element(values, middle);
  return *middle;
}

std::optional<Eigen::Vector3f> ColourWithin(const render::Image& picture, const Region& region, double least_share) {
  std::array<std::vector<uint8_t>, 3> coloured;
  size_t num_pixels = 0;
  for (size_t i = 0; i < region.mask().pixels.size(); ++i) {
    if (region.mask().pixels[i] == 0) continue;
    ++num_pixels;
    const uint8_t* rgb = &picture.pixels[3 * i];
    if (*std::max_element(rgb, rgb + 3) - *std::min_element(rgb, rgb + 3) < kLeastChroma) continue;
    for (size_t c = 0; c < 3; ++c) coloured[c].push_back(rgb[c]);
  }
  if (coloured[0].size() < kLeastPixels || double(coloured[0].size()) < least_share * double(num_pixels))
    return std::nullopt;
  Eigen::Vector3f colour;
  for (size_t c = 0; c < 3; ++c) colour[Eigen::Index(c)] = float(MedianOf(coloured[c])) / 255;
  return colour;
}

/// A part that has the skin's colour is not coloured.
void DropSkin(const std::optional<Eigen::Vector3f>& skin, std::optional<Eigen::Vector3f>& part) {
  if (skin && part && (*part - *skin).cwiseAbs().maxCoeff() < kLeastDifference) part.reset();
}

}  // namespace

DrawnColours FindDrawnColours(const render::Image& picture, const std::vector<render::Stroke>& curves) {
  if (picture.channels != 3) return {};
  const auto of_kind = [&](std::string_view kind) { return CurvesOfKind(curves, kind); };
  const std::vector<RegionOutline> brows = of_kind("brow"), lips = of_kind("lips"),
                                   mouth = Joined(of_kind("upper_mouth"), of_kind("lower_mouth")),
                                   eyes = Joined(of_kind("upper_eye"), of_kind("lower_eye"));
  const auto colour = [&](const Region& region, double least_share) {
    return ColourWithin(picture, region, least_share);
  };
  const Region empty(picture.height, picture.width);
  DrawnColours found;
  found.skin =
      colour(Region(empty).With(of_kind("silhouette")).Without(brows).Without(eyes).Without(lips).Without(mouth),
             kLeastSkinShare);
  found.lips = colour(Region(empty).With(lips).Without(mouth), kLeastPartShare);
  found.brows = colour(Region(empty).With(brows), kLeastPartShare);
  found.iris = colour(Region(empty).With(eyes), kLeastPartShare);
  for (std::optional<Eigen::Vector3f>* part : {&found.lips, &found.brows, &found.iris}) DropSkin(found.skin, *part);
  return found;
}

}  // namespace daumier::sketch
