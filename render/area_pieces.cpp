#include "render/area_pieces.h"

#include "core/statistics.h"
#include "render/ink.h"
#include "render/loose_ends.h"
#include "render/opencv_bridge.h"
#include "render/skeleton_graph.h"
#include "render/skeleton_tracing.h"
#include "render/thinning.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace daumier::render {
namespace {

using Eigen::AlignedBox2d;
using Eigen::Vector2d;

/// Pixels a pen's width, and the limits between which that is left as it is.
constexpr double kPenPixels = 12.0, kLeastPenPixels = 8.0, kMostPenPixels = 18.0;
/// The same of a piece that is much wider than the pen.
constexpr double kMostPiecePixels = 36.0;
/// Pixels of the longer side of a mask, that its layers may paint in all, and the paper around its ink.
constexpr double kMaxMaskSide = 2048.0, kLeastMaskSide = 512.0, kMaxLayerPixels = 1e8;
constexpr int kMaskMargin = 3;
/// How often the scale follows the width that was found.
constexpr int kNumScales = 3;
/// Area of a line, in squares of its width: a bar 4 times as long as wide, a leaf 5 times.
constexpr double kMinLineArea = 4.0;
/// Length of lines that hang on a thicker part, in widths of the pen, and the half thickness of that part.
constexpr double kMinLooseLength = 12.0, kThickHalfWidths = 1.2;
/// How far a spur may protrude from its junction, in half widths. The edges of areas are smooth, so that more is drawn.
constexpr double kMaxProtrusion = 0.45;
/// A piece with more edges is no drawing, but noise.
constexpr size_t kMaxEdges = 20'000;
/// Points of an outline by which it is assigned to a piece.
constexpr size_t kMaxVotes = 64;

double LargestScale(const AlignedBox2d& box) {
  return kMaxMaskSide / std::max(box.sizes().maxCoeff(), 1e-30);
}

/// The same for a mask of several layers.
double LargestScale(const std::vector<const PaintedArea*>& layers, const AlignedBox2d& box) {
  double area = 0.0;
  for (const PaintedArea* layer : layers) {
    const AlignedBox2d part = layer->shape.Box().intersection(box);
    if (!part.isEmpty()) area += part.volume();
  }
  const double affordable = std::sqrt(kMaxLayerPixels / std::max(area, 1e-30));
  return std::min(LargestScale(box), std::max(affordable, kLeastMaskSide / kMaxMaskSide * LargestScale(box)));
}

struct AreaMask {
  MaskFrame frame;
  Image ink;
};

AreaMask RasterisedLayers(const std::vector<const PaintedArea*>& layers, const AlignedBox2d& box, double scale) {
  AreaMask mask{{box.min() - Vector2d::Constant(kMaskMargin / scale), scale}, {}};
  const Vector2d size = scale * box.sizes();
  mask.ink = Image(static_cast<int>(std::ceil(size.y())) + 2 * kMaskMargin,
                   static_cast<int>(std::ceil(size.x())) + 2 * kMaskMargin, 1, kPaper);
  for (const PaintedArea* layer : layers) {
    FillArea(layer->shape, mask.frame, layer->paint == Paint::kInk ? kInk : kPaper, mask.ink);
  }
  return mask;
}

/// A mask of the layers at such a scale that the pen is kPenPixels wide; without ink where they have no inside.
AreaMask MaskAtPenScale(const std::vector<const PaintedArea*>& layers) {
  AlignedBox2d box;
  double least_width = 0.0;
  for (const PaintedArea* layer : layers) {
    const double width = RoughWidth(layer->shape);
    if (layer->paint == Paint::kPaper || width == 0.0) continue;
    box.extend(layer->shape.Box());
    least_width = least_width == 0.0 ? width : std::min(least_width, width);
  }
  if (box.isEmpty()) return {};
  const double largest_scale = LargestScale(layers, box);
  double scale = std::min(kPenPixels / least_width, largest_scale);
  AreaMask mask = RasterisedLayers(layers, box, scale);
  for (int i = 1; i < kNumScales; ++i) {
    const double pen_pixels = PenWidth(mask.ink);
    if (pen_pixels >= kLeastPenPixels && pen_pixels <= kMostPenPixels) break;
    const double better = std::min(scale * kPenPixels / std::max(pen_pixels, 1.0), largest_scale);
    if (better == scale) break;
    scale = better;
    mask = RasterisedLayers(layers, box, scale);
  }
  return mask;
}

/// Distances to the paper along a skeleton, in pixels: half the width of the ink.
std::vector<double> HalfWidthsAlong(const Image& skeleton, const Image& ink) {
  cv::Mat inside, distance;
  cv::bitwise_not(MatView(ink), inside);
  cv::distanceTransform(inside, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  std::vector<double> half_widths;
  for (int row = 0; row < ink.height; ++row) {
    for (int column = 0; column < ink.width; ++column) {
      if (skeleton.at(row, column) == kInk) half_widths.push_back(distance.at<float>(row, column) - 0.5);
    }
  }
  return half_widths;
}

/// The middle lines of ink in its own pixels; none where it is noise.
std::vector<Stroke> MiddleLines(const Image& ink, const Image& skeleton, double width) {
  SkeletonGraph graph = GraphOfSkeleton(skeleton, ink);
  if (graph.edges.size() > kMaxEdges) return {};
  graph = WithoutThinningArtefacts(std::move(graph), kMaxProtrusion);
  return WithFullEnds(TraceSkeleton(graph), graph, ink, width);
}

/// A mask of fewer pixels, each of which has the colour at its centre.
AreaMask Coarser(const AreaMask& mask, double factor) {
  const auto shrunk = [&](int side) { return std::max(1, static_cast<int>(std::ceil(side * factor))); };
  AreaMask coarse{{mask.frame.origin, factor * mask.frame.scale},
                  Image(shrunk(mask.ink.height), shrunk(mask.ink.width), 1, kPaper)};
  for (int row = 0; row < coarse.ink.height; ++row) {
    for (int column = 0; column < coarse.ink.width; ++column) {
      const auto at = [&](int index, int side) { return std::min(static_cast<int>((index + 0.5) / factor), side - 1); };
      coarse.ink.at(row, column) = mask.ink.at(at(row, mask.ink.height), at(column, mask.ink.width));
    }
  }
  return coarse;
}

/// Sets the shape, the widths, the length and the lines of a piece from its own mask.
void MeasurePiece(const AreaMask& mask, double max_width, AreaPiece& piece) {
  const double scale = mask.frame.scale;
  const Image skeleton = Thin(mask.ink);
  const auto half_widths = HalfWidthsAlong(skeleton, mask.ink);
  const auto num_inked = static_cast<double>(std::count(mask.ink.pixels.begin(), mask.ink.pixels.end(), kInk));
  const double pen = 2.0 * Median(half_widths);
  if (pen > kMostPiecePixels) return MeasurePiece(Coarser(mask, kPenPixels / pen), max_width, piece);
  const double width = 2.0 * Percentile(half_widths, 90.0);
  piece.length = static_cast<double>(half_widths.size()) / scale;
  piece.pen_width = pen / scale;
  piece.width = width / scale;

  const bool is_long = num_inked >= kMinLineArea * width * width && piece.width <= max_width;
  const double thick = kThickHalfWidths * pen;
  const auto num_thin = std::count_if(half_widths.begin(), half_widths.end(), [&](double x) { return x <= thick; });
  const bool has_loose_lines = piece.pen_width <= max_width && static_cast<double>(num_thin) >= kMinLooseLength * pen &&
                               num_thin < std::ssize(half_widths);
  if (!is_long && !has_loose_lines && piece.width > kMaxDotWidths * max_width) return;

  const double line_width = is_long ? width : pen;
  const Image hollow = HollowAreas(mask.ink, line_width);
  piece.lines = MiddleLines(hollow, hollow == mask.ink ? skeleton : Thin(hollow), line_width);
  if ((is_long || has_loose_lines) && !piece.lines.empty()) piece.shape = PieceShape::kLine;
  for (Stroke& stroke : piece.lines) {
    for (auto& [x, y] : stroke.points) {
      const Vector2d point = mask.frame.origin + Vector2d(x, y) / scale;
      x = static_cast<float>(point.x());
      y = static_cast<float>(point.y());
    }
  }
}

/// The label on which most of the points of an outline border; 0 where there is none.
int LabelAlong(const std::vector<Vector2d>& outline, const MaskFrame& frame, const cv::Mat& labels) {
  std::vector<int> votes;
  const size_t num_segments = outline.size();
  const size_t step = 1 + num_segments / kMaxVotes;
  for (size_t i = 0; i < num_segments; i += step) {
    const Vector2d middle = 0.5 * (outline[i] + outline[(i + 1) % num_segments]);
    const Vector2d pixel = frame.scale * (middle - frame.origin);
    for (const int row_step : {-1, 0, 1}) {
      for (const int column_step : {-1, 0, 1}) {
        const int row = static_cast<int>(pixel.y()) + row_step, column = static_cast<int>(pixel.x()) + column_step;
        if (row < 0 || column < 0 || row >= labels.rows || column >= labels.cols) continue;
        if (const int label = labels.at<int>(row, column); label != 0) votes.push_back(label);
      }
    }
  }
  std::sort(votes.begin(), votes.end());
  int best = 0;
  size_t most = 0;
  for (size_t first = 0; first < votes.size();) {
    size_t end = first;
    while (end < votes.size() && votes[end] == votes[first]) ++end;
    if (end - first > most) {
      most = end - first;
      best = votes[first];
    }
    first = end;
  }
  return best;
}

/// The part of a mask that has a label, with a margin.
AreaMask Cropped(const AreaMask& mask, const cv::Mat& labels, int label, const cv::Rect& box) {
  AreaMask piece{
      {mask.frame.origin + Vector2d(box.x - kMaskMargin, box.y - kMaskMargin) / mask.frame.scale, mask.frame.scale},
      Image(box.height + 2 * kMaskMargin, box.width + 2 * kMaskMargin, 1, kPaper)};
  for (int row = 0; row < box.height; ++row) {
    for (int column = 0; column < box.width; ++column) {
      if (labels.at<int>(box.y + row, box.x + column) == label) {
        piece.ink.at(row + kMaskMargin, column + kMaskMargin) = kInk;
      }
    }
  }
  return piece;
}

}  // namespace

std::vector<AreaPiece> FindAreaPieces(const std::vector<const PaintedArea*>& layers, double max_width) {
  const AreaMask mask = MaskAtPenScale(layers);
  if (mask.ink.pixels.empty()) return {};
  cv::Mat inside, labels, stats, centres;
  cv::bitwise_not(MatView(mask.ink), inside);
  const int num_labels = cv::connectedComponentsWithStats(inside, labels, stats, centres, 8, CV_32S);
  std::vector<AreaPiece> pieces(num_labels - 1);
  for (int label = 1; label < num_labels; ++label) {
    const cv::Rect box(stats.at<int>(label, cv::CC_STAT_LEFT), stats.at<int>(label, cv::CC_STAT_TOP),
                       stats.at<int>(label, cv::CC_STAT_WIDTH), stats.at<int>(label, cv::CC_STAT_HEIGHT));
    MeasurePiece(Cropped(mask, labels, label, box), max_width, pieces[label - 1]);
  }
  for (const PaintedArea* layer : layers) {
    if (layer->paint == Paint::kPaper) continue;
    for (const auto& outline : layer->shape.outlines) {
      const int label = LabelAlong(outline, mask.frame, labels);
      if (label == 0) continue;
      AreaPiece& piece = pieces[label - 1];
      piece.outlines.push_back(StrokesThrough({outline})[0]);
      if (piece.areas.empty() || piece.areas.back() != layer) piece.areas.push_back(layer);
    }
  }
  return pieces;
}

double RoughWidth(const FilledArea& area) {
  double doubled_area = 0.0, length = 0.0;
  const Vector2d origin = area.outlines.empty() || area.outlines[0].empty() ? Vector2d(0, 0) : area.outlines[0][0];
  for (const auto& outline : area.outlines) {
    for (size_t i = 0; i < outline.size(); ++i) {
      const Vector2d from = outline[i] - origin, to = outline[(i + 1) % outline.size()] - origin;
      doubled_area += from.x() * to.y() - from.y() * to.x();
      length += (to - from).norm();
    }
  }
  constexpr double kLeastShare = 1e-6;  // Rounding of the coordinates.
  const double width = length > 0.0 ? std::abs(doubled_area) / length : 0.0;
  return width > kLeastShare * length ? width : 0.0;
}

double NumPixelsFor(const FilledArea& area) {
  const double width = RoughWidth(area);
  const AlignedBox2d box = area.Box();
  if (width == 0.0 || box.isEmpty()) return 0.0;
  const double scale = std::min(kPenPixels / width, LargestScale(box));
  return scale * scale * box.volume();
}

std::vector<Stroke> StrokesThrough(const std::vector<std::vector<Vector2d>>& polylines) {
  std::vector<Stroke> strokes;
  for (const auto& polyline : polylines) {
    Stroke stroke;
    for (const Vector2d& point : polyline) {
      stroke.points.push_back({static_cast<float>(point.x()), static_cast<float>(point.y())});
    }
    strokes.push_back(std::move(stroke));
  }
  return strokes;
}

}  // namespace daumier::render
