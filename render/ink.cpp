#include "render/ink.h"

#include "core/statistics.h"
#include "render/opencv_bridge.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <span>
#include <vector>

namespace daumier::render {
namespace {

/// Darkness, 255 = black, below which a pixel is always paper, and which the threshold never exceeds.
constexpr double kPaperGrain = 12, kSureInk = 150;
/// Standard deviations of the paper's noise that ink must exceed.
constexpr double kNumNoiseDeviations = 4.0;
/// Shares of Otsu's threshold: what is darker than the first is ink; darker than the second, if it hangs together with
/// it.
constexpr double kSureShare = 0.7, kFaintShare = 0.45;
/// Share of the darkest value near by that ink must have, so that lines side by side stay apart, and how near that is,
/// in pixels.
constexpr double kShareOfDarkest = 0.5;
constexpr int kDarkestReach = 3;
/// Area of the smallest speck of ink and hole in it that are kept, in squares of the pen's width.
constexpr double kMinSpeck = 1.5, kMinHole = 1.0;
/// Limits of those areas in pixels, whatever the pen.
constexpr double kLeastSpeck = 6.0, kLargestSpeck = 60.0;
/// Gap between two areas that make one, in widths of the pen, and the smallest hole in an area that is kept, in squares
/// of it: glints in pupils and hair.
constexpr double kAreaGap = 1.0, kMinAreaHole = 25.0;
/// Small pieces, in squares of the pen's width, are only kept if their darkest pixel has this share of the darkness
/// that three quarters of the ink stay below: what is fainter is dirt, or noise where there was little light.
constexpr double kSmallPiece = 30.0, kShareOfTypical = 0.6;
/// Half the thickness of an area whose outline is drawn, in widths of the pen, and in pixels at least.
constexpr double kAreaHalfThickness = 1.2, kMinAreaHalfThickness = 5.0;
/// How far from the border a frame can begin and end, and how far it can depart from a straight line (shares of the
/// side across it); the share of the side along it that it must cover.
constexpr double kFrameDepth = 0.08, kFrameReach = 0.25, kFrameBend = 0.008, kFrameCover = 0.7;

/// Distance of each pixel to the nearest that is not 0.
cv::Mat DistanceTo(const cv::Mat& mask) {
  cv::Mat outside, distance;
  cv::bitwise_not(mask, outside);
  cv::distanceTransform(outside, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  return distance;
}

cv::Mat DistanceToPaper(const Image& ink) {
  return DistanceTo(MatView(ink));
}

/// Median plus a multiple of the deviation of the darkness, most of which is paper.
double NoiseLimit(const cv::Mat& darkness) {
  std::vector<uint8_t> values(darkness.begin<uint8_t>(), darkness.end<uint8_t>());
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::nth_element(values.begin(), middle, values.end());
  const int median = *middle;
  for (uint8_t& value : values) value = static_cast<uint8_t>(std::abs(value - median));
  std::nth_element(values.begin(), middle, values.end());
  return median + kNumNoiseDeviations * 1.4826 * *middle;
}

/// The components of `faint` that hold a pixel of `sure`, both 255 where true.
cv::Mat ConnectedTo(const cv::Mat& sure, const cv::Mat& faint) {
  cv::Mat labels;
  const int num_labels = cv::connectedComponents(faint, labels, 8, CV_32S);
  std::vector<bool> is_kept(num_labels, false);
  for (int row = 0; row < labels.rows; ++row) {
    for (int column = 0; column < labels.cols; ++column) {
      if (sure.at<uint8_t>(row, column) != 0) is_kept[labels.at<int>(row, column)] = true;
    }
  }
  is_kept[0] = false;
  cv::Mat kept(faint.size(), CV_8U);
  for (int row = 0; row < labels.rows; ++row) {
    for (int column = 0; column < labels.cols; ++column) {
      kept.at<uint8_t>(row, column) = is_kept[labels.at<int>(row, column)] ? 255 : 0;
    }
  }
  return kept;
}

/// A straight line across a mask.
struct Slope {
  double row, slope;  ///< At column 0, and rows a column.
  double At(int column) const { return row + slope * column; }
};

/// The line through the medians of the left and the right third of points, at least three, sorted by column.
Slope SlopeThrough(const std::vector<cv::Point>& points) {
  const auto third = std::ssize(points) / 3;
  const auto median_row = [](std::span<const cv::Point> part) {
    std::vector<double> rows;
    for (const cv::Point point : part) rows.push_back(point.y);
    return Median(rows);
  };
  const double left = median_row({points.begin(), points.begin() + third});
  const double right = median_row({points.end() - third, points.end()});
  const int left_column = points[third / 2].x, right_column = points[std::ssize(points) - 1 - third / 2].x;
  const double slope = (right - left) / std::max(1, right_column - left_column);
  return {left - slope * left_column, slope};
}

/// Clears what lies along the top of a mask that is 255 where there is ink: the first run of ink in each column, if in
/// most columns these begin on one straight line near the top and end on another. A line of the drawing that meets the
/// frame is cut there.
void ClearFrameOnTop(cv::Mat ink) {
  std::vector<cv::Point> starts, ends;
  for (int column = 0; column < ink.cols; ++column) {
    const auto is_ink = [&](int row) { return ink.at<uint8_t>(row, column) != 0; };
    int start = 0;
    while (start < kFrameDepth * ink.rows && !is_ink(start)) ++start;
    if (!is_ink(start)) continue;
    int end = start;
    while (end < ink.rows && is_ink(end)) ++end;
    starts.emplace_back(column, start);
    ends.emplace_back(column, end);
  }
  const auto num_needed = std::max<int64_t>(3, static_cast<int64_t>(std::ceil(kFrameCover * ink.cols)));
  if (std::ssize(starts) < num_needed) return;
  const Slope first = SlopeThrough(starts), last = SlopeThrough(ends);
  const double bend = std::max(1.5, kFrameBend * ink.rows);
  int64_t num_straight = 0;
  for (size_t i = 0; i < starts.size(); ++i) {
    const int column = starts[i].x;
    num_straight += std::abs(starts[i].y - first.At(column)) <= bend && std::abs(ends[i].y - last.At(column)) <= bend;
  }
  if (num_straight < num_needed || last.At(ink.cols / 2) > kFrameReach * ink.rows) return;
  for (size_t i = 0; i < starts.size(); ++i) {
    const int column = starts[i].x;
    const int end = std::min(ends[i].y, static_cast<int>(std::ceil(last.At(column) + bend)));
    for (int row = 0; row < std::min(end, ink.rows); ++row) ink.at<uint8_t>(row, column) = 0;
  }
}

/// On all four sides.
void ClearFrame(cv::Mat& ink) {
  for (int side = 0; side < 4; ++side) {
    ClearFrameOnTop(ink);
    cv::rotate(ink, ink, cv::ROTATE_90_CLOCKWISE);
  }
}

/// Clears pieces of a mask of 0 and 255 that are smaller than an area in pixels.
void ClearSmallPieces(cv::Mat& mask, double min_area, int connectivity) {
  cv::Mat labels, stats, centres;
  cv::connectedComponentsWithStats(mask, labels, stats, centres, connectivity, CV_32S);
  for (int row = 0; row < mask.rows; ++row) {
    for (int column = 0; column < mask.cols; ++column) {
      if (stats.at<int>(labels.at<int>(row, column), cv::CC_STAT_AREA) < min_area) mask.at<uint8_t>(row, column) = 0;
    }
  }
}

/// Clears small pieces of the ink that are fainter than its lines.
void ClearFaintPieces(cv::Mat& ink, const cv::Mat& darkness, double max_area) {
  cv::Mat labels, stats, centres;
  const int num_labels = cv::connectedComponentsWithStats(ink, labels, stats, centres, 8, CV_32S);
  std::vector<uint8_t> darkest(num_labels, 0), values;
  for (int row = 0; row < ink.rows; ++row) {
    for (int column = 0; column < ink.cols; ++column) {
      if (ink.at<uint8_t>(row, column) == 0) continue;
      const uint8_t value = darkness.at<uint8_t>(row, column);
      uint8_t& darkest_of_piece = darkest[labels.at<int>(row, column)];
      darkest_of_piece = std::max(darkest_of_piece, value);
      values.push_back(value);
    }
  }
  if (values.empty()) return;
  const auto rank = values.begin() + 3 * std::ssize(values) / 4;
  std::nth_element(values.begin(), rank, values.end());
  for (int row = 0; row < ink.rows; ++row) {
    for (int column = 0; column < ink.cols; ++column) {
      const int label = labels.at<int>(row, column);
      const bool is_small = stats.at<int>(label, cv::CC_STAT_AREA) < max_area;
      if (is_small && darkest[label] < kShareOfTypical * *rank) ink.at<uint8_t>(row, column) = 0;
    }
  }
}

/// A mask from a matrix that is 255 where there is ink.
Image MaskOf(const cv::Mat& ink) {
  Image mask(ink.rows, ink.cols, 1);
  cv::Mat view = MatView(mask);
  cv::bitwise_not(ink, view);
  return mask;
}

}  // namespace

Image InkMask(const Image& flattened) {
  cv::Mat darkness, ignored;
  cv::bitwise_not(MatView(flattened), darkness);
  const double otsu = cv::threshold(darkness, ignored, 0, 255, cv::THRESH_BINARY | cv::THRESH_OTSU);
  const double grain = std::max(kPaperGrain, NoiseLimit(darkness));
  const double sure = std::clamp(kSureShare * otsu, std::min(grain, kSureInk), kSureInk);
  const double faint = std::clamp(kFaintShare * otsu, std::min(grain, sure), sure);
  cv::Mat darkest;
  constexpr int kWindow = 2 * kDarkestReach + 1;
  cv::dilate(darkness, darkest, cv::getStructuringElement(cv::MORPH_RECT, {kWindow, kWindow}));
  const cv::Mat stands_out = darkness > kShareOfDarkest * darkest;
  cv::Mat ink = ConnectedTo((darkness > sure) & stands_out, (darkness > faint) & stands_out);
  if (cv::countNonZero(ink) == static_cast<int>(ink.total())) ink.setTo(0);  // Black all over: no lines either.
  ClearFrame(ink);
  const double pen_width = PenWidth(MaskOf(ink));
  const double dot = pen_width * pen_width;
  ClearSmallPieces(ink, std::clamp(kMinSpeck * dot, kLeastSpeck, kLargestSpeck), 8);
  ClearFaintPieces(ink, darkness, kSmallPiece * dot);
  Image mask = MaskOf(ink);
  cv::Mat paper = MatView(mask);
  ClearSmallPieces(paper, std::min(kMinHole * dot, kLargestSpeck), 4);
  return mask;
}

double PenWidth(const Image& ink) {
  const cv::Mat distance = DistanceToPaper(ink);
  cv::Mat largest_near;
  cv::dilate(distance, largest_near, cv::getStructuringElement(cv::MORPH_RECT, {3, 3}));
  std::vector<double> ridge;
  for (int row = 0; row < distance.rows; ++row) {
    for (int column = 0; column < distance.cols; ++column) {
      const float value = distance.at<float>(row, column);
      if (value > 0 && value >= largest_near.at<float>(row, column)) ridge.push_back(value);
    }
  }
  if (ridge.empty()) return 0.0;
  // The distance to the centre of the nearest pixel of paper is half a pixel more than that to its edge.
  return 2.0 * Median(ridge) - 1.0;
}

Image HollowAreas(const Image& ink, double pen_width) {
  const double half_thickness = std::max(kMinAreaHalfThickness, kAreaHalfThickness * pen_width);
  const cv::Mat core = DistanceToPaper(ink) > half_thickness;
  if (cv::countNonZero(core) == 0) return ink;
  // What a disc of that thickness can reach inside the ink, and gaps between two such areas.
  cv::Mat areas = DistanceTo(core) <= half_thickness;
  const int gap = 2 * static_cast<int>(std::ceil(0.5 * kAreaGap * pen_width)) + 1;
  cv::morphologyEx(areas, areas, cv::MORPH_CLOSE, cv::getStructuringElement(cv::MORPH_ELLIPSE, {gap, gap}));
  cv::Mat outside;
  cv::bitwise_not(areas, outside);
  ClearSmallPieces(outside, kMinAreaHole * pen_width * pen_width, 4);
  cv::bitwise_not(outside, areas);
  Image hollow = ink;
  cv::Mat view = MatView(hollow);
  view.setTo(kInk, areas);
  view.setTo(kPaper, areas & (DistanceToPaper(hollow) > std::max(2.0, pen_width)));
  return hollow;
}

}  // namespace daumier::render
