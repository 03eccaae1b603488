#include "render/soft_shading.h"

#include "core/error.h"
#include "render/opencv_bridge.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace daumier::render {
namespace {

/// Side of the window whose brightest pixel is what lies under lines: wider than these, in pixels.
constexpr int kWiderThanLines = 15;
/// Blur of the shading, which has the grain of pencil, in pixels.
constexpr double kGrainBlur = 2.5;
/// Darkness, of 255, of an area's border, and the smallest area in pixels.
constexpr double kBorderDarkness = 18.0;
constexpr int kMinShadedArea = 400;
/// The share of an area's pixels that are darker than its typical darkness, and that at least: no ink is fainter.
constexpr double kTypicalDarkness = 0.2, kLeastTypical = 28.0;
/// A border is an edge where this share of the darkness further inside, or of the typical one, is reached within a
/// distance, in pixels, and this many of 255; and the share of a border that edges may have.
constexpr double kEdgeDarkness = 0.55, kMaxEdgeShare = 0.4;
constexpr double kLeastEdge = 28.0;
constexpr int kEdgeReach = 5, kInsideReach = 20;

cv::Mat Disc(int diameter) {
  return cv::getStructuringElement(cv::MORPH_ELLIPSE, {diameter, diameter});
}

/// The darkest pixels within both reaches of a pixel of a border.
struct BorderPixel {
  uint8_t near, inside;
};

/// What is measured of one connected dark area.
struct DarkArea {
  std::vector<uint8_t> darkness;  ///< Of all its pixels.
  std::vector<BorderPixel> border;

  bool IsSoft() {
    if (std::ssize(darkness) < kMinShadedArea || border.empty()) return false;
    const auto rank = static_cast<int64_t>((1.0 - kTypicalDarkness) * static_cast<double>(darkness.size() - 1));
    std::nth_element(darkness.begin(), darkness.begin() + rank, darkness.end());
    if (darkness[rank] < kLeastTypical) return false;
    const double typical = darkness[rank];
    const auto num_edges = std::count_if(border.begin(), border.end(), [&](const BorderPixel& pixel) {
      return pixel.near >= std::max(kLeastEdge, kEdgeDarkness * std::min<double>(pixel.inside, typical));
    });
    return static_cast<double>(num_edges) <= kMaxEdgeShare * static_cast<double>(border.size());
  }
};

}  // namespace

std::optional<Image> SoftShading(const Image& even) {
  DAUMIER_CHECK(even.channels == 1, "a picture of {} channels, expected 1", even.channels);
  cv::Mat ground, darkness;
  cv::morphologyEx(MatView(even), ground, cv::MORPH_CLOSE, Disc(kWiderThanLines));
  cv::GaussianBlur(ground, ground, {0, 0}, kGrainBlur);
  cv::bitwise_not(ground, darkness);
  const cv::Mat is_dark = darkness > kBorderDarkness;
  cv::Mat labels, near, inside, inner;
  const int num_labels = cv::connectedComponents(is_dark, labels, 8, CV_32S);
  if (num_labels < 2) return {};
  cv::dilate(darkness, near, Disc(2 * kEdgeReach + 1));
  cv::dilate(darkness, inside, Disc(2 * kInsideReach + 1));
  // The border of the picture is no border of an area.
  cv::erode(is_dark, inner, Disc(3));
  std::vector<DarkArea> areas(num_labels);
  for (int row = 0; row < labels.rows; ++row) {
    for (int column = 0; column < labels.cols; ++column) {
      DarkArea& area = areas[labels.at<int>(row, column)];
      if (is_dark.at<uint8_t>(row, column) == 0) continue;
      area.darkness.push_back(darkness.at<uint8_t>(row, column));
      if (inner.at<uint8_t>(row, column) == 0) {
        area.border.push_back({near.at<uint8_t>(row, column), inside.at<uint8_t>(row, column)});
      }
    }
  }
  cv::Mat is_soft(labels.size(), CV_8U, cv::Scalar(0));
  std::vector<bool> soft_labels(num_labels, false);
  for (int label = 1; label < num_labels; ++label) soft_labels[label] = areas[label].IsSoft();
  if (std::none_of(soft_labels.begin(), soft_labels.end(), [](bool is_soft_label) { return is_soft_label; })) return {};
  for (int row = 0; row < labels.rows; ++row) {
    for (int column = 0; column < labels.cols; ++column) {
      if (soft_labels[labels.at<int>(row, column)]) is_soft.at<uint8_t>(row, column) = 255;
    }
  }
  // The ramp continues beyond its border, except into other areas.
  cv::Mat others = is_dark & ~is_soft;
  cv::dilate(is_soft, is_soft, Disc(kWiderThanLines));
  is_soft.setTo(0, others);
  Image shading(even.height, even.width, 1, 255);
  cv::Mat view = MatView(shading);
  ground.copyTo(view, is_soft);
  return shading;
}

}  // namespace daumier::render
