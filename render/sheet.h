#pragma once
#include "render/image.h"

#include <string>
#include <vector>

namespace daumier::render {

struct SheetCell {
  Image image;               ///< May be empty: the place stays free.
  std::string caption = {};  ///< One line below the image.
};

struct SheetStyle {
  std::string title = {};                       ///< Above the sheet.
  std::vector<std::string> column_titles = {};  ///< Above the columns.
  std::vector<std::string> row_titles = {};     ///< Left of the rows; their width is made to fit.
  int gap = 10;                                 ///< Pixels between cells and at the border.
  double text_height = 16.0;
  Rgb background = {255, 255, 255};
};

/// A grid of pictures, row by row, `columns` in a row. Each column is as wide as its widest picture and each row as
/// high as its highest; smaller pictures are centred. Lines for captions and titles are only kept where there are any;
/// text that is too wide for its cell is drawn smaller. RGB.
/// @throws Error if there is no picture, columns is not positive, or there are more titles than columns or rows.
Image MakeSheet(const std::vector<SheetCell>& cells, int columns, const SheetStyle& style = {});

}  // namespace daumier::render
