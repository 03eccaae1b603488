#include "datasets/gallery/styled_sheet.h"

#include "datasets/styles/drawing_raster.h"
#include "datasets/styles/styled_dataset.h"
#include "render/draw.h"
#include "render/sheet.h"

#include <numeric>

namespace daumier::datasets {
namespace {

constexpr int kNumStyled = 64, kStyledInARow = 8, kStyledCell = 200;

template <class T, size_t N>
std::string_view NameOf(const ShownWith<T>& state, const std::array<std::string_view, N>& names) {
  return state.is_shown() ? names[size_t(state.value)] : std::string_view("-");
}

/// A thin grey border, since paper is white.
render::Image Bordered(render::Image image) {
  constexpr render::Rgb kGrey = {222, 222, 222};
  render::FillRectangle(image, 0, 0, 1, image.width, kGrey);
  render::FillRectangle(image, image.height - 1, 0, 1, image.width, kGrey);
  render::FillRectangle(image, 0, 0, image.height, 1, kGrey);
  render::FillRectangle(image, 0, image.width - 1, image.height, 1, kGrey);
  return image;
}

render::SheetStyle CloseCells() {
  render::SheetStyle style;
  style.gap = 4;
  style.text_height = 13;
  return style;
}

}  // namespace

std::vector<StyledDrawing> DrawingsOfSheet(const SketchDatabase& sketches, int count) {
  // A step that is prime to usual numbers of levels and expressions visits all of them.
  constexpr int kStep = 29;
  std::vector<int> faces;
  for (int i = 0; i < count; ++i) faces.push_back(static_cast<int>(int64_t(i) * kStep % sketches.num_faces()));
  StyledReading reading;
  reading.styles.page.prefix = 0.1;
  const StyledDataset dataset({{sketches, faces}}, reading, 0);
  std::vector<StyledDrawing> drawings;
  for (int i = 0; i < count; ++i) drawings.push_back(dataset.Drawing(i, 0));
  return drawings;
}

render::Image StyledSheet(const SketchDatabase& sketches) {
  std::vector<render::SheetCell> cells;
  for (const StyledDrawing& drawing : DrawingsOfSheet(sketches, kNumStyled))
    cells.push_back({Bordered(render::ToRgb(RasteriseDrawing(drawing, kStyledCell, PenView::kAsDrawn)))});
  return render::MakeSheet(cells, kStyledInARow, CloseCells());
}

render::Image StyledLabelSheet(const SketchDatabase& sketches) {
  std::vector<render::SheetCell> cells;
  for (const StyledDrawing& drawing : DrawingsOfSheet(sketches, kNumStyled)) {
    const std::string caption = fmt::format(
        "{} {} {} {}", NameOf(drawing.mouth, faces::kMouthStateNames), NameOf(drawing.eyes[0], faces::kEyeStateNames),
        NameOf(drawing.eyes[1], faces::kEyeStateNames), NameOf(drawing.view, faces::kDrawnViewNames));
    cells.push_back({Bordered(ColouredDrawing(drawing, kStyledCell)), caption});
  }
  return render::MakeSheet(cells, kStyledInARow, CloseCells());
}

}  // namespace daumier::datasets
