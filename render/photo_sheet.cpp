#include "render/photo_sheet.h"

#include "core/statistics.h"
#include "render/cross_product.h"
#include "render/photo_grey.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>

namespace daumier::render {
namespace {

using Eigen::Vector2d;

/// Longer sides of the pictures in which areas are sought and in which their sides are fitted.
constexpr int kSearchSide = 400, kFitSide = 1600;
/// Side of the closing's window that removes the drawing's lines, as a share of the longer side.
constexpr double kSheetLineWindow = 0.05;
/// Levels of the threshold.
constexpr int kFirstLevel = 20, kLastLevel = 240, kLevelStep = 8;
/// Shares of the picture that a sheet covers, at least and at most.
constexpr double kMinSheetArea = 0.06, kMaxSheetArea = 0.985;
/// Area of the convex hull over that of the quadrilateral, at least and at most, and the share of the quadrilateral
/// that is as bright as the sheet.
constexpr double kMinHullShare = 0.88, kMaxHullShare = 1.04, kMinBrightShare = 0.5;
/// Distance of hull and polygon as a share of the hull's length, and from the border of the picture within which a side
/// is the picture's own, in pixels.
constexpr double kPolygonTolerance = 0.012, kBorderReach = 3.0;
/// A corner outside the picture, as a share of its longer side.
constexpr double kMaxCornerOutside = 0.08;
/// Number of profiles across a side, the share of the side at its ends that has none, and half a profile's length as a
/// share of the sheet's smaller side.
constexpr int kNumProfiles = 120;
constexpr double kCornerShare = 0.04, kProfileReach = 0.025;
/// Step of brightness across a side, at least: in grey levels and as a share of the brighter of both.
constexpr double kMinStep = 10.0, kMinRelativeStep = 0.08;
/// Distance from the fitted line within which a profile agrees, in pixels of the picture in which sides are fitted,
/// and the share of profiles on a side that must agree.
constexpr double kSideTolerance = 1.5, kMinSideShare = 0.55;
/// Distances beyond the side, in halves of a profile's length, in which the desk is compared with the sheet, and the
/// share of profiles that must show it.
constexpr double kDeskFrom = 1.0, kDeskTo = 1.8, kMinDeskShare = 0.6;
/// The share of all profiles that must show the desk where other sheets lie next to it or below it, up to
/// where, so that lines that rule the paper are none, the shares of the picture that such a sheet covers, of it that
/// its outline fills, and of profiles on a side that must agree.
constexpr double kMinDeskAmongSheets = 0.3, kDeskToAmongSheets = 4.0, kMinAreaAmongSheets = 0.12,
                 kMinFilledAmongSheets = 0.9, kMinSideShareAmongSheets = 0.7;
/// Window of the opening that cuts bridges between sheets, in pixels of the picture in which areas are sought.
constexpr int kBridgeWindow = 7;
using Quad = std::array<Vector2d, 4>;

double AreaOf(const Quad& quad) {
  double area = 0.0;
  for (int i = 0; i < 4; ++i) area += 0.5 * CrossProduct(quad[i], quad[(i + 1) % 4]);
  return area;
}

/// A line through a point.
struct SideLine {
  Vector2d point, direction;
};

/// The corners in which consecutive lines meet, if they are a convex quadrilateral that is clockwise on the screen.
std::optional<Quad> QuadOf(const std::array<SideLine, 4>& lines) {
  Quad quad;
  for (int i = 0; i < 4; ++i) {
    const SideLine &a = lines[(i + 3) % 4], &b = lines[i];
    const double cross = CrossProduct(a.direction, b.direction);
    if (std::abs(cross) < 0.2) return {};
    quad[i] = a.point + CrossProduct(b.point - a.point, b.direction) / cross * a.direction;
  }
  for (int i = 0; i < 4; ++i) {
    const Vector2d side = quad[(i + 1) % 4] - quad[i], next = quad[(i + 2) % 4] - quad[(i + 1) % 4];
    if (CrossProduct(side, next) <= 0.2 * side.norm() * next.norm()) return {};
  }
  return quad;
}

/// The quadrilateral of the four longest sides of a closed outline's hull. `size` is that of the picture.
std::optional<Quad> QuadOfOutline(const std::vector<cv::Point>& outline, const cv::Size& size) {
  std::vector<cv::Point> hull, polygon;
  cv::convexHull(outline, hull, /*clockwise=*/false);  // On the screen, where y points down, it is clockwise.
  cv::approxPolyDP(hull, polygon, kPolygonTolerance * cv::arcLength(hull, true), true);
  const int count = static_cast<int>(polygon.size());
  if (count < 4) return {};
  const auto vertex = [&](int i) { return Vector2d(polygon[i % count].x + 0.5, polygon[i % count].y + 0.5); };
  const auto is_on_border = [&](const Vector2d& a, const Vector2d& b) {
    const auto both = [&](double from, double to) { return from <= kBorderReach && to <= kBorderReach; };
    return both(a.x(), b.x()) || both(a.y(), b.y()) || both(size.width - a.x(), size.width - b.x()) ||
           both(size.height - a.y(), size.height - b.y());
  };
  std::vector<int> sides;
  for (int i = 0; i < count; ++i) {
    if (!is_on_border(vertex(i), vertex(i + 1))) sides.push_back(i);
  }
  if (sides.size() < 4) return {};
  const auto length = [&](int i) { return (vertex(i + 1) - vertex(i)).norm(); };
  std::stable_sort(sides.begin(), sides.end(), [&](int a, int b) { return length(a) > length(b); });
  sides.resize(4);
  std::sort(sides.begin(), sides.end());
  std::array<SideLine, 4> lines;
  for (int i = 0; i < 4; ++i) lines[i] = {vertex(sides[i]), (vertex(sides[i] + 1) - vertex(sides[i])).normalized()};
  const auto quad = QuadOf(lines);
  if (!quad) return {};
  const double share = cv::contourArea(hull) / AreaOf(*quad);
  if (share < kMinHullShare || share > kMaxHullShare) return {};
  return quad;
}

/// Where sheets lie: each on the desk, or some on others, from which only the edge's shadow sets them apart.
enum class Ground { kDesk, kOtherSheets };

/// The picture without the drawing's lines. `grey` is small.
cv::Mat WithoutLines(const cv::Mat& grey) {
  const int window = 2 * static_cast<int>(0.5 * kSheetLineWindow * std::max(grey.rows, grey.cols)) + 1;
  // Beyond the picture is desk, so that a narrow strip of desk along the border is not closed.
  cv::Mat closed;
  cv::copyMakeBorder(grey, closed, window, window, window, window, cv::BORDER_CONSTANT, cv::Scalar(0));
  cv::morphologyEx(closed, closed, cv::MORPH_CLOSE, cv::getStructuringElement(cv::MORPH_ELLIPSE, {window, window}));
  return closed(cv::Rect(window, window, grey.cols, grey.rows)).clone();
}

/// The picture with dark gaps between areas made wider where they are narrow or interrupted.
cv::Mat WithoutBridges(const cv::Mat& grey) {
  cv::Mat opened;
  cv::morphologyEx(grey, opened, cv::MORPH_OPEN,
                   cv::getStructuringElement(cv::MORPH_ELLIPSE, {kBridgeWindow, kBridgeWindow}));
  return opened;
}

/// Quadrilaterals of areas brighter than each level, in pixels of `grey`, whose outline fills that share of them.
std::vector<Quad> RoughQuads(const cv::Mat& grey, double min_filled_share) {
  std::vector<Quad> quads;
  const double picture_area = static_cast<double>(grey.total());
  for (int level = kFirstLevel; level <= kLastLevel; level += kLevelStep) {
    cv::Mat labels, stats, centres;
    const int num_labels = cv::connectedComponentsWithStats(grey > level, labels, stats, centres, 4, CV_32S);
    for (int label = 1; label < num_labels; ++label) {
      const double area = stats.at<int>(label, cv::CC_STAT_AREA);
      if (area < kMinBrightShare * kMinSheetArea * picture_area) continue;
      std::vector<std::vector<cv::Point>> outlines;
      cv::findContours(labels == label, outlines, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_SIMPLE);
      if (outlines.empty()) continue;
      const auto quad = QuadOfOutline(outlines[0], grey.size());
      if (!quad) continue;
      const double share = AreaOf(*quad) / picture_area;
      if (share < kMinSheetArea || share > kMaxSheetArea || area < kMinBrightShare * AreaOf(*quad)) continue;
      if (cv::contourArea(outlines[0]) >= min_filled_share * AreaOf(*quad)) quads.push_back(*quad);
    }
  }
  return quads;
}

/// Brightness between pixel centres; nothing outside the picture.
std::optional<double> BrightnessAt(const cv::Mat& grey, const Vector2d& point) {
  const double x = point.x() - 0.5, y = point.y() - 0.5;
  const int column = static_cast<int>(std::floor(x)), row = static_cast<int>(std::floor(y));
  if (column < 0 || row < 0 || column + 1 >= grey.cols || row + 1 >= grey.rows) return {};
  const double s = x - column, t = y - row;
  return (1 - t) * ((1 - s) * grey.at<uint8_t>(row, column) + s * grey.at<uint8_t>(row, column + 1)) +
         t * ((1 - s) * grey.at<uint8_t>(row + 1, column) + s * grey.at<uint8_t>(row + 1, column + 1));
}

/// Median of the brightness along a straight line between two distances from a point.
std::optional<double> MedianAlong(const cv::Mat& grey, const Vector2d& point, const Vector2d& direction, double from,
                                  double to) {
  std::vector<double> values;
  for (double distance = from; distance <= to; distance += 1.0) {
    if (const auto value = BrightnessAt(grey, point + distance * direction)) values.push_back(*value);
  }
  if (values.empty()) return {};
  return Median(values);
}

/// Where the brightness falls most along a profile that leaves the sheet, as a distance from its middle; nothing if it
/// falls by less than a step.
std::optional<double> StepAlong(const cv::Mat& grey, const Vector2d& middle, const Vector2d& outwards, double reach) {
  constexpr double kStride = 0.5, kHalfStep = 2.0;
  std::vector<double> falls;
  std::vector<double> places;
  for (double distance = -reach; distance <= reach; distance += kStride) {
    double inside = 0.0, outside = 0.0;
    bool is_complete = true;
    for (const double offset : {0.5, 1.0, 1.5, kHalfStep}) {
      const auto before = BrightnessAt(grey, middle + (distance - offset) * outwards);
      const auto after = BrightnessAt(grey, middle + (distance + offset) * outwards);
      is_complete = is_complete && before && after;
      if (!is_complete) break;
      inside += 0.25 * *before;
      outside += 0.25 * *after;
    }
    if (!is_complete) continue;
    falls.push_back(inside - outside);
    places.push_back(distance);
  }
  if (falls.size() < 3) return {};
  const auto largest = std::max_element(falls.begin() + 1, falls.end() - 1) - falls.begin();
  if (falls[largest] < kMinStep) return {};
  const double left = falls[largest - 1], right = falls[largest + 1], bend = left - 2.0 * falls[largest] + right;
  const double shift = bend < 0.0 ? std::clamp(0.5 * (left - right) / bend, -1.0, 1.0) : 0.0;
  return places[largest] + kStride * shift;
}

/// The line that most of the points lie on, and their share.
struct FittedSide {
  SideLine line;
  double share = 0.0;
};

FittedSide FitSide(const std::vector<Vector2d>& points, int num_profiles) {
  FittedSide best;
  const auto agrees = [&](const SideLine& line, const Vector2d& point) {
    return std::abs(CrossProduct(line.direction, point - line.point)) <= kSideTolerance;
  };
  const auto count = [&](const SideLine& line) {
    return std::count_if(points.begin(), points.end(), [&](const Vector2d& point) { return agrees(line, point); });
  };
  // Lines through two points that are far from each other; then least squares on those that agree.
  int64_t most = 0;
  const auto size = std::ssize(points);
  for (int64_t i = 0; i < size / 2; ++i) {
    for (int64_t j = i + size / 3; j < size; j += 3) {
      const Vector2d along = points[j] - points[i];
      if (along.norm() < 1.0) continue;
      const SideLine line{points[i], along.normalized()};
      const int64_t num_agreeing = count(line);
      if (num_agreeing > most) {
        most = num_agreeing;
        best.line = line;
      }
    }
  }
  for (int round = 0; round < 3 && most >= 2; ++round) {
    std::vector<cv::Point2d> agreeing;
    for (const Vector2d& point : points) {
      if (agrees(best.line, point)) agreeing.emplace_back(point.x(), point.y());
    }
    if (agreeing.size() < 2) break;
    cv::Vec4d line;
    cv::fitLine(agreeing, line, cv::DIST_L2, 0, 1e-3, 1e-3);
    const Vector2d direction = Vector2d(line[0], line[1]).normalized();
    best.line = {Vector2d(line[2], line[3]), direction.dot(best.line.direction) < 0 ? -direction : direction};
  }
  best.share = static_cast<double>(count(best.line)) / num_profiles;
  return best;
}

/// A quadrilateral with its sides on steps of brightness, and the share of a side that shows one, at least.
struct FittedSheet {
  Quad quad;
  double least_share;
};

/// Nothing if a side has no step.
std::optional<FittedSheet> FittedQuad(const cv::Mat& grey, const Quad& rough, Ground ground) {
  double smaller_side = (rough[1] - rough[0]).norm();
  for (int i = 1; i < 4; ++i) smaller_side = std::min(smaller_side, (rough[(i + 1) % 4] - rough[i]).norm());
  const double reach = std::max(4.0, kProfileReach * smaller_side);
  const double desk_to = ground == Ground::kDesk ? kDeskTo : kDeskToAmongSheets;
  std::array<SideLine, 4> lines;
  int num_before_desk = 0;
  double desk_share = 0.0, least_share = 1.0;
  for (int i = 0; i < 4; ++i) {
    const Vector2d from = rough[i], along = rough[(i + 1) % 4] - from;
    const Vector2d outwards = Vector2d(along.y(), -along.x()).normalized();
    std::vector<Vector2d> points;
    int num_inside = 0, num_with_desk = 0;
    for (int k = 0; k < kNumProfiles; ++k) {
      const double share = kCornerShare + (1.0 - 2.0 * kCornerShare) * (k + 0.5) / kNumProfiles;
      const Vector2d middle = from + share * along;
      if (!BrightnessAt(grey, middle)) continue;
      ++num_inside;
      const auto step = StepAlong(grey, middle, outwards, reach);
      if (!step) continue;
      points.push_back(middle + *step * outwards);
      const auto sheet = MedianAlong(grey, points.back(), -outwards, 2.0, reach);
      const auto desk = MedianAlong(grey, points.back(), outwards, kDeskFrom * reach, desk_to * reach);
      num_with_desk += sheet && (!desk || *sheet - *desk > std::max(kMinStep, kMinRelativeStep * *sheet));
    }
    if (num_inside < kNumProfiles / 3) return {};
    const FittedSide side = FitSide(points, num_inside);
    if (side.share < (ground == Ground::kDesk ? kMinSideShare : kMinSideShareAmongSheets)) return {};
    lines[i] = side.line;
    least_share = std::min(least_share, side.share);
    num_before_desk += num_with_desk >= kMinDeskShare * num_inside;
    desk_share += 0.25 * num_with_desk / num_inside;
  }
  if (ground == Ground::kDesk && num_before_desk < 4) return {};
  if (ground == Ground::kOtherSheets &&
      (desk_share < kMinDeskAmongSheets || AreaOf(rough) < kMinAreaAmongSheets * static_cast<double>(grey.total())))
    return {};
  const auto quad = QuadOf(lines);
  return quad ? std::optional(FittedSheet{*quad, least_share}) : std::nullopt;
}

/// The same corners, those of the most upright side first.
PhotoSheet Upright(const Quad& quad) {
  int first = 0;
  const auto rightwards = [&](int i) { return (quad[(i + 1) % 4] - quad[i]).normalized().x(); };
  for (int i = 1; i < 4; ++i) {
    if (rightwards(i) > rightwards(first)) first = i;
  }
  PhotoSheet sheet;
  for (int i = 0; i < 4; ++i) sheet.corners[i] = quad[(first + i) % 4];
  return sheet;
}

bool IsNearPicture(const Quad& quad, const cv::Size& size) {
  const double reach = kMaxCornerOutside * std::max(size.width, size.height);
  return std::all_of(quad.begin(), quad.end(), [&](const Vector2d& corner) {
    return corner.x() >= -reach && corner.y() >= -reach && corner.x() <= size.width + reach &&
           corner.y() <= size.height + reach;
  });
}

bool IsSame(const Quad& a, const Quad& b, double tolerance) {
  for (int i = 0; i < 4; ++i) {
    bool is_found = false;
    for (int j = 0; j < 4; ++j) is_found = is_found || (a[i] - b[j]).norm() <= tolerance;
    if (!is_found) return false;
  }
  return true;
}

std::vector<FittedSheet> FittedQuads(const cv::Mat& grey, Ground ground) {
  const cv::Mat coarse = ShrunkTo(grey, kSearchSide), fine = ShrunkTo(grey, kFitSide);
  const Eigen::Array2d fine_from_coarse(static_cast<double>(fine.cols) / coarse.cols,
                                        static_cast<double>(fine.rows) / coarse.rows);
  const double tolerance = 0.01 * std::max(fine.rows, fine.cols);
  std::vector<Quad> candidates, rough;
  std::vector<FittedSheet> fitted;
  if (ground == Ground::kDesk) {
    candidates = RoughQuads(WithoutLines(coarse), kMinBrightShare);
  } else {
    candidates = RoughQuads(coarse, kMinFilledAmongSheets);
    const std::vector<Quad> more = RoughQuads(WithoutBridges(coarse), kMinFilledAmongSheets);
    candidates.insert(candidates.end(), more.begin(), more.end());
  }
  for (Quad quad : candidates) {
    for (Vector2d& corner : quad) corner = corner.array() * fine_from_coarse;
    const auto is_known = [&](const Quad& other) { return IsSame(quad, other, 0.5 * tolerance); };
    if (std::any_of(rough.begin(), rough.end(), is_known)) continue;
    rough.push_back(quad);
    if (!IsNearPicture(quad, fine.size())) continue;
    const auto better = FittedQuad(fine, quad, ground);
    if (!better || !IsNearPicture(better->quad, fine.size())) continue;
    const auto is_found = [&](const FittedSheet& other) { return IsSame(better->quad, other.quad, tolerance); };
    if (std::none_of(fitted.begin(), fitted.end(), is_found)) fitted.push_back(*better);
  }
  const Eigen::Array2d picture_from_fine(static_cast<double>(grey.cols) / fine.cols,
                                         static_cast<double>(grey.rows) / fine.rows);
  for (FittedSheet& sheet : fitted) {
    for (Vector2d& corner : sheet.quad) corner = corner.array() * picture_from_fine;
  }
  std::stable_sort(fitted.begin(), fitted.end(),
                   [](const FittedSheet& a, const FittedSheet& b) { return AreaOf(a.quad) > AreaOf(b.quad); });
  return fitted;
}

}  // namespace

std::vector<PhotoSheet> FindSheets(const Image& picture) {
  if (picture.pixels.empty()) return {};
  cv::Mat grey = LeastChannel(picture);
  std::vector<FittedSheet> fitted = FittedQuads(grey, Ground::kDesk);
  if (fitted.empty()) {
    cv::Mat inverted;
    cv::bitwise_not(grey, inverted);
    fitted = FittedQuads(inverted, Ground::kDesk);
  }
  // A quadrilateral of which much is not seen may be the hull of several sheets: those that are wholly seen come first.
  if (fitted.empty() || fitted[0].least_share < kMinSideShareAmongSheets) {
    std::vector<FittedSheet> among_sheets = FittedQuads(grey, Ground::kOtherSheets);
    fitted.insert(fitted.begin(), among_sheets.begin(), among_sheets.end());
  }
  std::vector<PhotoSheet> sheets;
  for (const FittedSheet& sheet : fitted) sheets.push_back(Upright(sheet.quad));
  return sheets;
}

}  // namespace daumier::render
