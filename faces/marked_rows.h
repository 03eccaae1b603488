#pragma once
#include "faces/marked_points.h"

#include <string_view>

namespace daumier::faces {

/// The points of text in rows (ReadMarkedPoints). Rows of numbers alone that are no points give dimension 1, all numbers
/// in their order.
MarkedPoints ParseMarkedRows(std::string_view text, const std::filesystem::path& path);

}  // namespace daumier::faces
