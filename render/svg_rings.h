#pragma once
#include "render/svg_path.h"

#include <Eigen/Geometry>

#include <optional>
#include <vector>

namespace daumier::render {

/// The box of a line's points; empty if there is none.
Eigen::AlignedBox2d BoxOfLine(const SvgPolyline& polyline);
Eigen::AlignedBox2d BoxOfLines(const std::vector<SvgPolyline>& polylines);

/// Whether a line that is closed by its first point surrounds anything: its points are not all on one straight line.
bool HasInside(const SvgPolyline& polyline);

/// The box of a line that is a closed rectangle with sides along the axes, its corners rounded or not.
std::optional<Eigen::AlignedBox2d> RectangleOf(const SvgPolyline& polyline);

}  // namespace daumier::render
