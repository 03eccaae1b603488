#include "render/styles/picture_lines.h"

#include <algorithm>
#include <cmath>

namespace daumier::render {
namespace {

constexpr float kLeastStep = 0.35f;    ///< Cm: smaller steps of depth are no border.
constexpr float kFullStep = 1.4f;      ///< Cm: greater ones are drawn as outlines.
constexpr float kEyeContrast = 0.22f;  ///< Difference of albedo at which colours of an eye meet in a line.

/// How strong the line between two things on the surface is; parts and classes may be equal.
float StrengthBetween(PicturePart part, PicturePart other_part, PictureClass here, PictureClass other) {
  using enum PicturePart;
  const auto is = [&](PicturePart wanted) { return part == wanted || other_part == wanted; };
  if (part != other_part) {
    if (is(kHighlight) || is(kLens) || is(kBrow)) return 0;
    if (is(kLash)) return 0.3f;
    if (is(kLidRim)) return is(kEyeball) ? 0.7f : 0.0f;
    if (is(kTeeth)) return is(kMouth) ? 0.2f : 0.6f;
    if (is(kBeard)) return 0.45f;
    return 0.9f;
  }
  if (here == other || part == kEyeball) return 0;
  const auto shows = [&](PictureClass wanted) { return here == wanted || other == wanted; };
  if (shows(PictureClass::kBrows) || shows(PictureClass::kEars)) return 0;
  if (shows(PictureClass::kMouth)) return 0.7f;
  if (shows(PictureClass::kLips)) return 0.3f;
  if (shows(PictureClass::kEyes)) return 0.7f;
  return 0.6f;
}

/// Strength of the border between two neighbouring samples, along x (axis 0) or y.
float BorderStrength(const PictureBuffers& buffers, size_t here, size_t there, int axis) {
  const bool is_covered = buffers.is_covered(here);
  if (is_covered != buffers.is_covered(there)) return 1;
  if (!is_covered) return 0;
  const auto part = static_cast<PicturePart>(buffers.parts[here]),
             other = static_cast<PicturePart>(buffers.parts[there]);
  float strength = 0;
  if (part != other || buffers.classes[here] != buffers.classes[there]) {
    strength = StrengthBetween(part, other, static_cast<PictureClass>(buffers.classes[here]),
                               static_cast<PictureClass>(buffers.classes[there]));
  } else if (part == PicturePart::kEyeball) {
    float contrast = 0;
    for (int channel = 0; channel < 3; ++channel) {
      contrast = std::max(contrast, std::abs(buffers.albedo[3 * here + channel] - buffers.albedo[3 * there + channel]));
    }
    if (contrast > kEyeContrast) strength = 0.35f;
  }
  const float step = std::abs(buffers.depth[here] - buffers.depth[there]);
  if (step > kLeastStep && part != PicturePart::kEyeball && other != PicturePart::kEyeball) {
    // Along a slope, neighbouring samples differ by tan / pixels_per_cm.
    const auto slope = [&](size_t pixel) {
      return std::abs(buffers.normal[3 * pixel + axis]) / std::max(buffers.normal[3 * pixel + 2], 0.15f);
    };
    const float expected = 1.5f * std::min(slope(here), slope(there)) / buffers.pixels_per_cm;
    const float beyond = (step - expected - kLeastStep) / (kFullStep - kLeastStep);
    if (beyond > 0) strength = std::max(strength, 0.35f + 0.6f * std::min(beyond, 1.0f));
  }
  return strength;
}

/// Whether two samples may have a border between them; false for most, at little cost.
bool MayHaveBorder(const PictureBuffers& buffers, size_t here, size_t there) {
  if (buffers.classes[here] != buffers.classes[there] || buffers.parts[here] != buffers.parts[there]) return true;
  const float depth = buffers.depth[here], other = buffers.depth[there];
  if (depth >= PictureBuffers::kBackgroundDepth && other >= PictureBuffers::kBackgroundDepth) return false;
  return buffers.parts[here] == static_cast<uint8_t>(PicturePart::kEyeball) || !(std::abs(depth - other) <= kLeastStep);
}

}  // namespace

std::vector<LinePoint> BorderLines(const PictureBuffers& buffers) {
  const int height = buffers.height, width = buffers.width;
  std::vector<LinePoint> points;
  std::vector<int> first_of_row(height + 1, 0);
  for (int row = 0; row < height; ++row) {
    first_of_row[row] = static_cast<int>(points.size());
    for (int column = 0; column < width; ++column) {
      const size_t here = size_t(row) * width + column;
      const float x = static_cast<float>(column), y = static_cast<float>(row);
      if (column + 1 < width && MayHaveBorder(buffers, here, here + 1)) {
        const float strength = BorderStrength(buffers, here, here + 1, 0);
        if (strength > 0) points.push_back({x + 1, y + 0.5f, strength});
      }
      if (row + 1 < height && MayHaveBorder(buffers, here, here + width)) {
        const float strength = BorderStrength(buffers, here, here + width, 1);
        if (strength > 0) points.push_back({x + 0.5f, y + 1, strength});
      }
    }
  }
  first_of_row[height] = static_cast<int>(points.size());

  // Points of a row are sorted by x (to within a half), so that neighbours of other rows are found by a moving start.
  constexpr int kRows = 2;
  constexpr float kReach = 2.6f;
  std::vector<LinePoint> smooth(points.size());
  const float scale = 1.0f / static_cast<float>(buffers.supersampling);
  for (int row = 0; row < height; ++row) {
    std::array<int, 2 * kRows + 1> start{};
    for (int i = -kRows; i <= kRows; ++i) start[i + kRows] = first_of_row[std::clamp(row + i, 0, height)];
    for (int index = first_of_row[row]; index < first_of_row[row + 1]; ++index) {
      const LinePoint& point = points[index];
      float x = 0, y = 0, total = 0;
      for (int i = -kRows; i <= kRows; ++i) {
        if (row + i < 0 || row + i >= height) continue;
        int& from = start[i + kRows];
        const int end = first_of_row[row + i + 1];
        while (from < end && points[from].x < point.x - kReach - 0.5f) ++from;
        for (int other = from; other < end && points[other].x <= point.x + kReach + 0.5f; ++other) {
          const float across = points[other].x - point.x, down = points[other].y - point.y;
          const float weight = 1 - (across * across + down * down) * (1 / (kReach * kReach));
          if (weight <= 0) continue;
          x += weight * points[other].x;
          y += weight * points[other].y;
          total += weight;
        }
      }
      smooth[index] = {scale * x / total, scale * y / total, point.strength};
    }
  }
  return smooth;
}

}  // namespace daumier::render
