#include "render/soft_shading.h"

#include "core/error.h"
#include "core/statistics.h"
#include "render/ink.h"
#include "render/opencv_bridge.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace daumier::render {
namespace {

/// Which shading is sought.
struct ShadingLimits {
  int window;         ///< Side in pixels of one whose brightest pixel is what lies under lines: wider than these.
  double grain_blur;  ///< Of the shading, which has the grain of pencil, in pixels.
  int least_area;     ///< In pixels.
  int edge_reach;     ///< Distance in pixels within which an edge climbs.
  double most_lines;  ///< Share of an area's pixels that are lines, at most.
  double darkest;     ///< Typical darkness of an area, at most.
};

/// Of wide shading, and of narrow: the window and the smallest area in widths of the pen and in windows, and the
/// darkness as a share of that of lines: as dark as these is soft ink, and where most is lines they are close together.
constexpr ShadingLimits kWideShading = {
    .window = 15, .grain_blur = 2.5, .least_area = 400, .edge_reach = 5, .most_lines = 1.0, .darkest = 255.0};
constexpr double kNarrowGrainBlur = 1.5, kWindowInPens = 2.5, kLeastAreaInWindows = 2.0, kShareOfLineDarkness = 0.7,
                 kMostLines = 0.35;
constexpr int kNarrowestWindow = 7, kWidestNarrowWindow = 10, kNarrowEdgeReach = 3;
/// What is darker than the shading by these, a factor and a number of 255, is a line on narrow shading; and how far a
/// line's blur reaches, in pixels.
constexpr double kLineOnShading = 1.5, kLeastLineOnShading = 20.0;
constexpr int kLineBlurReach = 2;
/// How far shading continues beyond its border, in pixels.
constexpr int kRampReach = 15;
/// Darkness, of 255, of an area's border.
constexpr double kBorderDarkness = 18.0;
/// The share of an area's pixels that are darker than its typical darkness, and that at least: no ink is fainter.
constexpr double kTypicalDarkness = 0.2, kLeastTypical = 28.0;
/// A border is an edge where the darkness climbs by the first share of that further inside, or of the typical one, but
/// to no more than the second share of it, within a distance, in pixels, and reaches this many of 255; and the share of
/// a border that edges may have.
constexpr double kEdgeClimb = 0.48, kEdgeDarkness = 0.85, kMaxEdgeShare = 0.4;
constexpr double kLeastEdge = 28.0;
constexpr int kInsideReach = 20;

cv::Mat Disc(int diameter) {
  return cv::getStructuringElement(cv::MORPH_ELLIPSE, {diameter, diameter});
}

/// 255 where the picture is clearly darker than what lies under its lines.
cv::Mat LinesOver(const cv::Mat& ground, const Image& even) {
  cv::Mat darkness, limit;
  cv::bitwise_not(MatView(even), darkness);
  ground.convertTo(limit, CV_8U, -kLineOnShading, kLineOnShading * 255.0 + kLeastLineOnShading);
  return darkness > limit;
}

/// The darkest pixels within both reaches of a pixel of a border.
struct BorderPixel {
  uint8_t near, inside;
};

/// What is measured of one connected dark area.
struct DarkArea {
  std::vector<uint8_t> darkness;  ///< Of all its pixels.
  std::vector<BorderPixel> border;
  int64_t num_lines = 0;

  bool IsSoft(const ShadingLimits& limits) {
    if (std::ssize(darkness) < limits.least_area || border.empty()) return false;
    if (static_cast<double>(num_lines) > limits.most_lines * static_cast<double>(darkness.size())) return false;
    const auto rank = static_cast<int64_t>((1.0 - kTypicalDarkness) * static_cast<double>(darkness.size() - 1));
    std::nth_element(darkness.begin(), darkness.begin() + rank, darkness.end());
    if (darkness[rank] < kLeastTypical || darkness[rank] > limits.darkest) return false;
    const double typical = darkness[rank];
    const auto num_edges = std::count_if(border.begin(), border.end(), [&](const BorderPixel& pixel) {
      const double full = std::min<double>(pixel.inside, typical);
      return pixel.near >= std::max(kLeastEdge, std::min(kBorderDarkness + kEdgeClimb * full, kEdgeDarkness * full));
    });
    return static_cast<double>(num_edges) <= kMaxEdgeShare * static_cast<double>(border.size());
  }
};

/// Shading within limits, or nothing.
std::optional<Image> ShadingWithin(const Image& even, const ShadingLimits& limits) {
  cv::Mat ground, darkness;
  cv::morphologyEx(MatView(even), ground, cv::MORPH_CLOSE, Disc(limits.window));
  cv::GaussianBlur(ground, ground, {0, 0}, limits.grain_blur);
  cv::bitwise_not(ground, darkness);
  const cv::Mat is_dark = darkness > kBorderDarkness;
  const cv::Mat lines = LinesOver(ground, even);
  cv::Mat labels, near, inside, inner;
  const int num_labels = cv::connectedComponents(is_dark, labels, 8, CV_32S);
  if (num_labels < 2) return {};
  cv::dilate(darkness, near, Disc(2 * limits.edge_reach + 1));
  cv::dilate(darkness, inside, Disc(2 * kInsideReach + 1));
  // The border of the picture is no border of an area.
  cv::erode(is_dark, inner, Disc(3));
  std::vector<DarkArea> areas(num_labels);
  for (int row = 0; row < labels.rows; ++row) {
    for (int column = 0; column < labels.cols; ++column) {
      DarkArea& area = areas[labels.at<int>(row, column)];
      if (is_dark.at<uint8_t>(row, column) == 0) continue;
      area.darkness.push_back(darkness.at<uint8_t>(row, column));
      area.num_lines += lines.at<uint8_t>(row, column) != 0;
      if (inner.at<uint8_t>(row, column) == 0) {
        area.border.push_back({near.at<uint8_t>(row, column), inside.at<uint8_t>(row, column)});
      }
    }
  }
  cv::Mat is_soft(labels.size(), CV_8U, cv::Scalar(0));
  std::vector<bool> soft_labels(num_labels, false);
  for (int label = 1; label < num_labels; ++label) soft_labels[label] = areas[label].IsSoft(limits);
  if (std::none_of(soft_labels.begin(), soft_labels.end(), [](bool is_soft_label) { return is_soft_label; })) return {};
  for (int row = 0; row < labels.rows; ++row) {
    for (int column = 0; column < labels.cols; ++column) {
      if (soft_labels[labels.at<int>(row, column)]) is_soft.at<uint8_t>(row, column) = 255;
    }
  }
  // The ramp continues beyond its border, except into other areas.
  cv::Mat others = is_dark & ~is_soft;
  cv::dilate(is_soft, is_soft, Disc(kRampReach));
  is_soft.setTo(0, others);
  Image shading(even.height, even.width, 1, 255);
  cv::Mat view = MatView(shading);
  ground.copyTo(view, is_soft);
  return shading;
}

/// The darkness that half of the pixels of lines exceed; 0 if there are none.
double LineDarkness(const cv::Mat& darkness, const Image& ink) {
  std::vector<double> values;
  for (int row = 0; row < ink.height; ++row) {
    for (int column = 0; column < ink.width; ++column) {
      if (ink.at(row, column) == kInk) values.push_back(darkness.at<uint8_t>(row, column));
    }
  }
  return values.empty() ? 0.0 : Median(values);
}

/// Limits of shading that is not much wider than the picture's lines; nothing if there are no lines, or only wide ones.
std::optional<ShadingLimits> LimitsOfNarrow(const Image& even) {
  const Image ink = InkMask(even);
  const int window = std::max(kNarrowestWindow, static_cast<int>(std::ceil(kWindowInPens * PenWidth(ink))));
  if (window > kWidestNarrowWindow) return {};
  cv::Mat darkness;
  cv::bitwise_not(MatView(even), darkness);
  return ShadingLimits{.window = window,
                       .grain_blur = kNarrowGrainBlur,
                       .least_area = static_cast<int>(kLeastAreaInWindows * window * window),
                       .edge_reach = kNarrowEdgeReach,
                       .most_lines = kMostLines,
                       .darkest = kShareOfLineDarkness * LineDarkness(darkness, ink)};
}

/// The window cuts the dark crests of narrow shading off: what is there and no line belongs to it.
void FillCrests(Image& shading, const Image& even) {
  cv::Mat view = MatView(shading), lines, crests;
  cv::dilate(LinesOver(view, even), lines, Disc(2 * kLineBlurReach + 1));
  cv::min(view, MatView(even), crests);
  crests.copyTo(view, (view < 255) & ~lines);
}

}  // namespace

std::optional<Image> SoftShading(const Image& even) {
  DAUMIER_CHECK(even.channels == 1, "a picture of {} channels, expected 1", even.channels);
  std::optional<Image> wide = ShadingWithin(even, kWideShading);
  Image without = even;
  if (wide) {
    FillCrests(*wide, even);
    cv::Mat view = MatView(without);
    cv::divide(MatView(even), MatView(*wide), view, 255.0);
  }
  const auto limits = LimitsOfNarrow(without);
  if (!limits) return wide;
  auto narrow = ShadingWithin(without, *limits);
  if (narrow) FillCrests(*narrow, without);
  if (!narrow || !wide) return narrow ? narrow : wide;
  cv::Mat view = MatView(*narrow);
  cv::multiply(MatView(*wide), view, view, 1.0 / 255.0);
  return narrow;
}

}  // namespace daumier::render
