#include "render/line_drawing.h"

#include "core/error.h"
#include "core/log.h"
#include "render/draw.h"
#include "render/ink.h"
#include "render/paper.h"
#include "render/photo_desk.h"
#include "render/photo_sheet.h"
#include "render/ruling.h"
#include "render/sheet_perspective.h"
#include "render/skeleton_graph.h"
#include "render/skeleton_tracing.h"
#include "render/thinning.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace daumier::render {

namespace {

/// A drawing is small if its longer side has at most this share of the picture's. The margin that is traced with it, as
/// a share of its own side and, at least, of kLineDrawingSide.
constexpr double kSmallDrawing = 0.5, kMargin = 0.2, kMinRegion = 0.1;

struct PictureRegion {
  int top, left, height, width;
};

/// The picture's strokes; nothing if it holds no lines.
std::optional<LineDrawing> Traced(const Image& picture) {
  const double scale = static_cast<double>(kLineDrawingSide) / std::max(picture.height, picture.width);
  const int height = std::max(1, static_cast<int>(std::lround(scale * picture.height)));
  const int width = std::max(1, static_cast<int>(std::lround(scale * picture.width)));

  LineDrawing result;
  result.flattened = NormaliseBackground(WithoutRuling(Resize(picture, height, width)));
  result.ink = InkMask(result.flattened);
  const double pen_width = PenWidth(result.ink);
  if (pen_width <= 0.0) return {};
  const Image lines = HollowAreas(result.ink, pen_width);
  result.skeleton = Thin(lines);

  const auto graph = WithoutThinningArtefacts(GraphOfSkeleton(result.skeleton, lines));
  result.drawing = {static_cast<double>(picture.width), static_cast<double>(picture.height), TraceSkeleton(graph)};
  const auto x_scale = static_cast<float>(picture.width) / static_cast<float>(width);
  const auto y_scale = static_cast<float>(picture.height) / static_cast<float>(height);
  for (auto& stroke : result.drawing.strokes) {
    for (auto& [x, y] : stroke.points) {
      x *= x_scale;
      y *= y_scale;
    }
  }
  return result;
}

/// The part of the picture round a drawing, if that is small and the picture has more pixels of it than were traced.
std::optional<PictureRegion> RegionOfSmall(const Drawing& drawing) {
  const double longer = std::max(drawing.width, drawing.height);
  Eigen::AlignedBox2d box;
  for (const Stroke& stroke : drawing.strokes) {
    for (const auto& [x, y] : stroke.points) box.extend(Eigen::Vector2d(x, y));
  }
  const double side = box.sizes().maxCoeff();
  if (longer <= kLineDrawingSide || side > kSmallDrawing * longer) return {};
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(std::max(kMargin * side, kMinRegion * kLineDrawingSide));
  const Eigen::Vector2i first = (box.min() - margin).cwiseMax(0.0).array().floor().cast<int>();
  const Eigen::Vector2i last =
      (box.max() + margin).cwiseMin(Eigen::Vector2d(drawing.width, drawing.height)).array().ceil().cast<int>();
  return PictureRegion{first.y(), first.x(), last.y() - first.y(), last.x() - first.x()};
}

/// The picture's strokes, of a small drawing from the part of the picture that it covers.
std::optional<LineDrawing> TracedClosely(const Image& picture) {
  auto whole = Traced(picture);
  if (!whole) return {};
  const auto region = RegionOfSmall(whole->drawing);
  if (!region) return whole;
  Image part(region->height, region->width, picture.channels);
  Paste(part, picture, -region->top, -region->left);
  auto close = Traced(part);
  if (!close) return whole;
  close->drawing.width = whole->drawing.width;
  close->drawing.height = whole->drawing.height;
  for (Stroke& stroke : close->drawing.strokes) {
    for (auto& [x, y] : stroke.points) {
      x += static_cast<float>(region->left);
      y += static_cast<float>(region->top);
    }
  }
  return close;
}

}  // namespace

LineDrawing TraceLineDrawing(const Image& picture) {
  DAUMIER_CHECK(!picture.pixels.empty(), "the picture is empty");
  const std::vector<PhotoSheet> sheets = FindSheets(picture);
  for (const PhotoSheet& sheet : sheets) {
    if (auto traced = TracedClosely(RectifySheet(picture, sheet))) {
      traced->drawing.picture_from_sheet = PictureFromRectified(sheet, picture.height, picture.width);
      return *std::move(traced);
    }
  }
  if (auto traced = TracedClosely(picture)) {
    if (sheets.empty() && ShowsDesk(picture)) {
      log::Warn(
          "the photo shows paper on a darker ground, but no sheet with four straight sides is found: its edges may be "
          "read as lines; crop the photo to the drawing");
    }
    return *std::move(traced);
  }
  throw Error("the picture holds no lines; expected dark lines on light paper, or light on dark");
}

}  // namespace daumier::render
