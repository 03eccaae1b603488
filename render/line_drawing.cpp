#include "render/line_drawing.h"

#include "core/error.h"
#include "render/draw.h"
#include "render/ink.h"
#include "render/paper.h"
#include "render/photo_sheet.h"
#include "render/ruling.h"
#include "render/skeleton_graph.h"
#include "render/skeleton_tracing.h"
#include "render/thinning.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace daumier::render {

namespace {

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

}  // namespace

LineDrawing TraceLineDrawing(const Image& picture) {
  DAUMIER_CHECK(!picture.pixels.empty(), "the picture is empty");
  for (const PhotoSheet& sheet : FindSheets(picture)) {
    if (auto traced = Traced(RectifySheet(picture, sheet))) return *std::move(traced);
  }
  if (auto traced = Traced(picture)) return *std::move(traced);
  throw Error("the picture holds no lines; expected dark lines on light paper, or light on dark");
}

}  // namespace daumier::render
