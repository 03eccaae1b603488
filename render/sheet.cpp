#include "render/sheet.h"

#include "core/error.h"
#include "render/draw.h"

#include <algorithm>
#include <cmath>

namespace daumier::render {
namespace {

/// Where columns and rows begin; sizes are those of the pictures, without captions.
struct Grid {
  std::vector<int> left, width, top, height;
  int total_width = 0, total_height = 0;
};

Grid LayOutGrid(const std::vector<SheetCell>& cells, int columns, int caption_height, int first_left, int first_top,
                int gap) {
  const int rows = (static_cast<int>(cells.size()) + columns - 1) / columns;
  Grid grid;
  grid.width.assign(columns, 0);
  grid.height.assign(rows, 0);
  std::vector<bool> has_caption(rows, false);
  for (size_t i = 0; i < cells.size(); ++i) {
    const size_t row = i / columns, column = i % columns;
    grid.width[column] = std::max(grid.width[column], cells[i].image.width);
    grid.height[row] = std::max(grid.height[row], cells[i].image.height);
    has_caption[row] = has_caption[row] || !cells[i].caption.empty();
  }
  int left = first_left, top = first_top;
  for (const int width : grid.width) {
    grid.left.push_back(left);
    left += width + gap;
  }
  for (int row = 0; row < rows; ++row) {
    grid.top.push_back(top);
    top += grid.height[row] + (has_caption[row] ? caption_height : 0) + gap;
  }
  grid.total_width = left;
  grid.total_height = top;
  return grid;
}

}  // namespace

Image MakeSheet(const std::vector<SheetCell>& cells, int columns, const SheetStyle& style) {
  DAUMIER_CHECK(!cells.empty(), "a sheet needs at least one picture");
  DAUMIER_CHECK(columns > 0, "a sheet of {} columns, expected at least 1", columns);
  const size_t rows = (cells.size() + columns - 1) / columns;
  DAUMIER_CHECK(style.column_titles.size() <= size_t(columns) && style.row_titles.size() <= rows,
                "{} column titles and {} row titles for a sheet of {} columns and {} rows", style.column_titles.size(),
                style.row_titles.size(), columns, rows);

  const TextStyle plain{.height = style.text_height, .align = TextAlign::kCentre};
  const TextStyle bold{.height = style.text_height, .align = TextAlign::kCentre, .bold = true};
  const TextStyle heading{.height = 1.4 * style.text_height, .bold = true};
  const TextStyle row_title{.height = style.text_height, .bold = true};
  const auto lines = [](const TextStyle& text) { return static_cast<int>(std::ceil(1.25 * text.height)); };

  int row_title_width = 0;
  for (const auto& title : style.row_titles) {
    row_title_width = std::max(row_title_width, static_cast<int>(std::ceil(TextWidth(title, row_title))) + style.gap);
  }
  const int heading_height = style.title.empty() ? 0 : lines(heading);
  const int column_title_height = style.column_titles.empty() ? 0 : lines(bold);
  const Grid grid = LayOutGrid(cells, columns, lines(plain), style.gap + row_title_width,
                               style.gap + heading_height + column_title_height, style.gap);

  Image sheet(grid.total_height, grid.total_width, 3);
  FillRectangle(sheet, 0, 0, sheet.height, sheet.width, style.background);
  DrawText(sheet, style.title, style.gap, style.gap,
           FittedTextStyle(style.title, heading, grid.total_width - 2 * style.gap));
  for (size_t column = 0; column < style.column_titles.size(); ++column) {
    const auto& title = style.column_titles[column];
    DrawText(sheet, title, grid.left[column] + 0.5 * grid.width[column], style.gap + heading_height,
             FittedTextStyle(title, bold, grid.width[column]));
  }
  for (size_t row = 0; row < style.row_titles.size(); ++row) {
    DrawText(sheet, style.row_titles[row], style.gap, grid.top[row] + 0.5 * (grid.height[row] - row_title.height),
             row_title);
  }
  for (size_t i = 0; i < cells.size(); ++i) {
    const size_t row = i / columns, column = i % columns;
    const Image& image = cells[i].image;
    Paste(sheet, image, grid.top[row] + (grid.height[row] - image.height) / 2,
          grid.left[column] + (grid.width[column] - image.width) / 2);
    DrawText(sheet, cells[i].caption, grid.left[column] + 0.5 * grid.width[column],
             grid.top[row] + grid.height[row] + 0.15 * plain.height,
             FittedTextStyle(cells[i].caption, plain, grid.width[column]));
  }
  return sheet;
}

}  // namespace daumier::render
