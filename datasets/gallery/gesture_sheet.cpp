#include "datasets/gallery/gesture_sheet.h"

#include "datasets/gestures/gesture_raster.h"
#include "render/sheet.h"

#include <algorithm>
#include <map>
#include <string>

namespace daumier::datasets {
namespace {

constexpr int kStrokeCell = 96;

}  // namespace

render::Image PictureOfStroke(const Polyline& stroke) {
  std::vector<float> ink(size_t{kStrokeCell} * kStrokeCell);
  RasteriseGesture(stroke, {.side = kStrokeCell, .width = 1.6}, ink);
  render::Image image(kStrokeCell, kStrokeCell, 1, 255);
  std::ranges::transform(ink, image.pixels.begin(), [](float share) { return uint8_t(255 - 255 * share + 0.5f); });
  return image;
}

render::Image GestureSheet(const std::vector<LabelledStroke>& strokes, int columns) {
  std::map<std::pair<Gesture, int>, std::vector<const LabelledStroke*>> rows;
  for (const LabelledStroke& stroke : strokes) {
    auto& row = rows[{stroke.gesture, stroke.other ? int(*stroke.other) : -1}];
    if (int(row.size()) < columns) row.push_back(&stroke);
  }
  render::SheetStyle style{.row_titles = {}, .gap = 4};
  std::vector<render::SheetCell> cells;
  for (const auto& [kind, row] : rows) {
    style.row_titles.push_back(kind.second < 0 ? NameOf(kind.first) : NameOf(OtherStrokeKind(kind.second)));
    for (int i = 0; i < columns; ++i)
      cells.push_back(i < int(row.size()) ? render::SheetCell{PictureOfStroke(row[size_t(i)]->points)}
                                          : render::SheetCell{});
  }
  return render::MakeSheet(cells, columns, style);
}

}  // namespace daumier::datasets
