#include "systems/portrait/landmark_overlay.h"

#include "core/error.h"
#include "render/draw.h"
#include "systems/portrait/landmark_sample.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace daumier::portrait {
namespace {

struct Chain {
  int begin, end;
  bool closed;
};

constexpr std::array<Chain, 9> kChains = {{{0, 17, false},
                                           {17, 22, false},
                                           {22, 27, false},
                                           {27, 31, false},
                                           {31, 36, false},
                                           {36, 42, true},
                                           {42, 48, true},
                                           {48, 60, true},
                                           {60, 68, true}}};
constexpr std::array<render::Rgb, 9> kChainColours = {{{60, 220, 120},
                                                       {255, 170, 40},
                                                       {255, 170, 40},
                                                       {90, 190, 255},
                                                       {90, 190, 255},
                                                       {255, 60, 60},
                                                       {255, 60, 60},
                                                       {240, 90, 220},
                                                       {240, 90, 220}}};
constexpr std::array<render::Rgb, 8> kClassColours = {{{0, 0, 0},
                                                       {255, 205, 150},
                                                       {255, 150, 0},
                                                       {40, 90, 255},
                                                       {230, 40, 90},
                                                       {120, 0, 60},
                                                       {120, 220, 120},
                                                       {150, 110, 230}}};

void Blend(render::Image& image, int row, int column, const render::Rgb& colour, double share) {
  if (row < 0 || column < 0 || row >= image.height || column >= image.width) return;
  for (int k = 0; k < 3; ++k) {
    uint8_t& value = image.at(row, column, k);
    value = uint8_t(std::lround((1 - share) * value + share * colour[size_t(k)]));
  }
}

/// All pixels near a segment, by the share of the line that covers them.
void DrawSegment(render::Image& image, const Eigen::Vector2d& from, const Eigen::Vector2d& to, double width,
                 const render::Rgb& colour) {
  if (!(from + to).allFinite()) return;
  const double reach = 0.5 * width + 1;
  const auto bound = [](double value, int size) { return std::clamp(int(std::floor(value)), 0, size); };
  const int first_row = bound(std::min(from.y(), to.y()) - reach, image.height),
            last_row = bound(std::max(from.y(), to.y()) + reach + 1, image.height),
            first = bound(std::min(from.x(), to.x()) - reach, image.width),
            last = bound(std::max(from.x(), to.x()) + reach + 1, image.width);
  const Eigen::Vector2d along = to - from;
  const double length2 = along.squaredNorm();
  for (int row = first_row; row < last_row; ++row)
    for (int column = first; column < last; ++column) {
      const Eigen::Vector2d at(column + 0.5, row + 0.5);
      const double t = length2 > 0 ? std::clamp((at - from).dot(along) / length2, 0.0, 1.0) : 0;
      const double share = std::clamp(0.5 * width + 0.5 - (from + t * along - at).norm(), 0.0, 1.0);
      if (share > 0) Blend(image, row, column, colour, share);
    }
}

void DrawChain(render::Image& image, std::span<const float> landmarks, const Chain& chain, double scale, double width,
               const render::Rgb& colour) {
  const auto at = [&](int i) {
    return Eigen::Vector2d(scale * double(landmarks[2 * size_t(i)]), scale * double(landmarks[2 * size_t(i) + 1]));
  };
  for (int i = chain.begin; i + 1 < chain.end; ++i) DrawSegment(image, at(i), at(i + 1), width, colour);
  if (chain.closed) DrawSegment(image, at(chain.end - 1), at(chain.begin), width, colour);
  for (int i = chain.begin; i < chain.end; ++i) DrawSegment(image, at(i), at(i), 2.2 * width, colour);
}

void CheckIsRgb(const render::Image& image, std::span<const float> landmarks) {
  DAUMIER_CHECK(image.channels == 3 && landmarks.size() == 2 * size_t(kNumLandmarks),
                "landmarks are drawn into RGB pictures, {} of them (found {} channels, {} numbers)", kNumLandmarks,
                image.channels, landmarks.size());
}

}  // namespace

render::Image Fitted(const render::Image& picture, int side) {
  const double scale = double(side) / std::max(picture.height, picture.width);
  return render::ToRgb(render::Resize(picture, std::max(1, int(std::lround(scale * picture.height))),
                                      std::max(1, int(std::lround(scale * picture.width)))));
}

void DrawLandmarks(render::Image& image, std::span<const float> landmarks, double scale, double width) {
  CheckIsRgb(image, landmarks);
  for (size_t i = 0; i < kChains.size(); ++i) DrawChain(image, landmarks, kChains[i], scale, width, kChainColours[i]);
}

void DrawLandmarks(render::Image& image, std::span<const float> landmarks, double scale, double width,
                   const render::Rgb& colour) {
  CheckIsRgb(image, landmarks);
  for (const Chain& chain : kChains) DrawChain(image, landmarks, chain, scale, width, colour);
}

void DrawBox(render::Image& image, const Box& box, double scale, const render::Rgb& colour) {
  const std::array<Eigen::Vector2d, 4> corners = {
      Eigen::Vector2d(box.left, box.top), {box.right, box.top}, {box.right, box.bottom}, {box.left, box.bottom}};
  for (size_t i = 0; i < 4; ++i) DrawSegment(image, scale * corners[i], scale * corners[(i + 1) % 4], 2, colour);
}

render::Image TintedByClasses(const render::Image& picture, const render::Image& mask) {
  DAUMIER_CHECK(mask.channels == 1 && mask.height == picture.height && mask.width == picture.width,
                "a mask of {} x {} with {} channels does not fit a picture of {} x {}", mask.height, mask.width,
                mask.channels, picture.height, picture.width);
  render::Image tinted = render::ToRgb(picture);
  for (int row = 0; row < mask.height; ++row)
    for (int column = 0; column < mask.width; ++column) {
      const size_t of_pixel = mask.at(row, column);
      if (of_pixel > 0 && of_pixel < kClassColours.size()) Blend(tinted, row, column, kClassColours[of_pixel], 0.6);
    }
  return tinted;
}

}  // namespace daumier::portrait
