#pragma once
#include "render/strokes.h"

#include <vector>

namespace daumier::render {

/// Strokes as a file has them: x right, y down, in the file's own pixels, of which the sheet is width x height large.
/// Strokes may leave the sheet.
struct Drawing {
  double width = 0.0, height = 0.0;
  std::vector<Stroke> strokes;
};

}  // namespace daumier::render
