#include "render/photo_desk.h"

#include "render/photo_grey.h"

#include <opencv2/imgproc.hpp>
#include <vector>

namespace daumier::render {
namespace {

/// Longer side of the picture that is examined, and of the window that removes lines, in pixels.
constexpr int kDeskSide = 200, kDeskLineWindow = 9;
constexpr double kMinPaper = 0.15, kMaxPaper = 0.85, kMinDarkBorder = 0.75, kMinSolidity = 0.75;
/// Grey levels between the means of paper and ground, at least.
constexpr double kMinPaperContrast = 40.0;

}  // namespace

bool ShowsDesk(const Image& picture) {
  if (picture.pixels.empty()) return false;
  cv::Mat grey = ShrunkTo(LeastChannel(picture), kDeskSide), bright;
  const cv::Mat window = cv::getStructuringElement(cv::MORPH_ELLIPSE, {kDeskLineWindow, kDeskLineWindow});
  // Neither dark lines on paper nor bright ones on a board are areas.
  cv::morphologyEx(grey, grey, cv::MORPH_CLOSE, window);
  cv::morphologyEx(grey, grey, cv::MORPH_OPEN, window);
  cv::threshold(grey, bright, 0, 255, cv::THRESH_BINARY | cv::THRESH_OTSU);
  const double total = static_cast<double>(bright.total());
  const double num_bright = cv::countNonZero(bright);
  if (num_bright == 0 || num_bright == total) return false;
  cv::Mat dark;
  cv::bitwise_not(bright, dark);
  if (cv::mean(grey, bright)[0] - cv::mean(grey, dark)[0] < kMinPaperContrast) return false;

  cv::Mat border = cv::Mat::ones(dark.size(), CV_8U);
  if (dark.rows > 2 && dark.cols > 2) border(cv::Rect(1, 1, dark.cols - 2, dark.rows - 2)).setTo(0);
  if (cv::countNonZero(dark & (border * 255)) < kMinDarkBorder * cv::countNonZero(border)) return false;

  std::vector<std::vector<cv::Point>> outlines;
  cv::findContours(bright, outlines, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_SIMPLE);
  const std::vector<cv::Point>* largest = nullptr;
  double area = 0.0;
  for (const auto& outline : outlines) {
    if (cv::contourArea(outline) <= area) continue;
    area = cv::contourArea(outline);
    largest = &outline;
  }
  if (!largest || area < kMinPaper * total || area > kMaxPaper * total) return false;
  std::vector<cv::Point> hull;
  cv::convexHull(*largest, hull);
  return area >= kMinSolidity * cv::contourArea(hull);
}

}  // namespace daumier::render
