#include "render/ruled_lines.h"

#include "core/statistics.h"
#include "render/opencv_bridge.h"

#include <algorithm>
#include <numbers>

namespace daumier::render {
namespace {

/// Angles at which lines are sought.
constexpr double kMaxAngle = 15.0, kAngleStep = 0.2;
/// Share of its length on which a line is dark: of one of many; and the same for the median of all lines
/// at an angle, which is the noise of the picture.
constexpr double kRegularCover = 0.6, kMaxNoiseCover = 0.35;
/// Number of lines and the least distance, in pixels, of a ruling; how far from it gaps may be, how many lines in a row
/// may be missing in it, and how many may be between two of it.
constexpr int kMinLines = 5;
constexpr double kMinDistance = 4.5, kDistanceTolerance = 0.17;
constexpr int kMaxMissing = 2, kMaxBetween = 4;

constexpr double kRadian = std::numbers::pi / 180.0;

/// For each v at an angle, from -reach to reach: the number of dark pixels on the line, per pixel of the picture's
/// width.
struct Covers {
  int reach = 0;
  std::vector<double> at;
};

Covers CoversAt(const std::vector<cv::Point2d>& dark, const cv::Size& size, double angle) {
  const double sine = std::sin(angle), cosine = std::cos(angle);
  Covers covers;
  covers.reach = static_cast<int>(std::ceil(0.5 * (size.height * cosine + size.width * std::abs(sine)))) + 1;
  covers.at.assign(2 * covers.reach + 1, 0.0);
  for (const cv::Point2d& point : dark) {
    covers.at[std::lround(point.y * cosine - point.x * sine) + covers.reach] += 1.0 / size.width;
  }
  return covers;
}

/// Share of the line's columns inside the picture that are dark within a pixel and a half of it; 0 of a line that is
/// shorter than half of the picture, in a corner.
double CoverOf(const cv::Mat& is_dark, const RuledLine& line) {
  int num_inside = 0, num_dark = 0;
  for (int column = 0; column < is_dark.cols; ++column) {
    const double row = line.RowAt(column + 0.5 - 0.5 * is_dark.cols) + 0.5 * is_dark.rows;
    if (row < 0 || row >= is_dark.rows) continue;
    ++num_inside;
    bool is_covered = false;
    for (int r = static_cast<int>(std::floor(row - 1.0)); r <= static_cast<int>(std::floor(row + 1.0)); ++r) {
      is_covered = is_covered || (r >= 0 && r < is_dark.rows && is_dark.at<uint8_t>(r, column) != 0);
    }
    num_dark += is_covered;
  }
  return 2 * num_inside < is_dark.cols ? 0.0 : static_cast<double>(num_dark) / num_inside;
}

/// Local maxima of the number of dark pixels that are lines.
std::vector<RuledLine> LinesAt(const cv::Mat& is_dark, const std::vector<cv::Point2d>& dark, double angle) {
  const Covers covers = CoversAt(dark, is_dark.size(), angle);
  std::vector<double> all;
  for (int v = -covers.reach; v <= covers.reach; v += 3) {
    all.push_back(CoverOf(is_dark, {angle, static_cast<double>(v), 0.0}));
  }
  const double noise = Median(all);
  if (noise > kMaxNoiseCover) return {};
  const double needed = kRegularCover + (1.0 - kRegularCover) * noise;
  const auto at = [&](int i) { return i < 0 || i > 2 * covers.reach ? 0.0 : covers.at[i]; };
  const auto smooth = [&](int i) { return at(i - 1) + at(i) + at(i + 1); };
  std::vector<RuledLine> lines;
  for (int i = 0; i <= 2 * covers.reach; ++i) {
    if (smooth(i) < 0.5 * kRegularCover || smooth(i) < smooth(i - 1) || smooth(i) <= smooth(i + 1)) continue;
    RuledLine line{angle, i + (at(i + 1) - at(i - 1)) / smooth(i) - covers.reach, 0.0};
    line.cover = CoverOf(is_dark, line);
    if (line.cover < needed) continue;
    if (!lines.empty() && line.v - lines.back().v < 0.5 * kMinDistance) continue;
    lines.push_back(line);
  }
  return lines;
}

/// Larger where the dark pixels are on fewer lines.
double Contrast(const std::vector<cv::Point2d>& dark, const cv::Size& size, double angle) {
  double sum = 0.0;
  for (const double cover : CoversAt(dark, size, angle).at) sum += cover * cover;
  return sum;
}

/// The lines from one to the last that follow each other at a distance; up to two in a row may be missing.
std::vector<int> ChainFrom(const std::vector<RuledLine>& lines, int first, double distance) {
  const double tolerance = std::max(1.2, kDistanceTolerance * distance);
  std::vector<int> chain = {first};
  for (int i = first + 1; i < std::ssize(lines); ++i) {
    const double gap = lines[i].v - lines[chain.back()].v, multiple = std::round(gap / distance);
    if (multiple > kMaxMissing + 1) break;
    if (multiple >= 1.0 && std::abs(gap - multiple * distance) <= tolerance) chain.push_back(i);
  }
  return chain;
}

}  // namespace

std::vector<RuledLine> RegularLines(const std::vector<RuledLine>& lines) {
  std::vector<int> longest;
  for (int i = 0; i < std::ssize(lines); ++i) {
    for (int j = i + 1; j < std::min<int>(i + kMaxBetween + 1, static_cast<int>(lines.size())); ++j) {
      const double distance = lines[j].v - lines[i].v;
      if (distance < kMinDistance) continue;
      const std::vector<int> chain = ChainFrom(lines, i, distance);
      if (chain.size() > longest.size()) longest = chain;
    }
  }
  std::vector<RuledLine> regular;
  if (std::ssize(longest) < kMinLines) return regular;
  for (const int i : longest) regular.push_back(lines[i]);
  return regular;
}

std::vector<RuledLine> LinesNearRows(const Image& mask) {
  const cv::Mat is_dark = MatView(mask);
  std::vector<cv::Point2d> dark;
  for (int row = 0; row < is_dark.rows; ++row) {
    for (int column = 0; column < is_dark.cols; ++column) {
      if (is_dark.at<uint8_t>(row, column) == 0) continue;
      dark.emplace_back(column + 0.5 - 0.5 * is_dark.cols, row + 0.5 - 0.5 * is_dark.rows);
    }
  }
  double best_angle = 0.0, best = Contrast(dark, is_dark.size(), 0.0);
  const int num_steps = static_cast<int>(std::lround(kMaxAngle / kAngleStep));
  for (int step = -num_steps; step <= num_steps; ++step) {
    const double angle = step * kAngleStep * kRadian, contrast = Contrast(dark, is_dark.size(), angle);
    if (contrast <= best) continue;
    best = contrast;
    best_angle = angle;
  }
  return LinesAt(is_dark, dark, best_angle);
}

}  // namespace daumier::render
