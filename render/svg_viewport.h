#pragma once
#include <Eigen/Geometry>

#include <optional>
#include <string_view>

namespace daumier::render {

/// What relative lengths refer to.
struct SvgUnits {
  double font_size = 16.0;                  ///< Pixels; of em, ex and ch.
  std::optional<Eigen::Vector2d> viewport;  ///< Width and height in the user space of the nearest <svg>; of %.
  std::optional<Eigen::Vector2d> sheet;     ///< Of the outermost <svg> in pixels; of vw and vh.
};

/// Which side of the viewport 100 % is: its width, its height, or its diagonal divided by sqrt(2).
enum class SvgAxis { kX, kY, kDiagonal };

/// Pixels of a length such as "12", "3.5mm", "1in" or "20%" [CSS Values 3]: px, pt, pc, mm, cm, in, Q, em, rem, ex, ch,
/// vw, vh, vmin, vmax or %, in capitals or not.
/// @throws Error if it is malformed, or relative to a size that is not known.
double ParseSvgLength(std::string_view text, SvgAxis axis, const SvgUnits& units);

/// x, y, width and height of a viewBox; nothing if the attribute is empty or `none`.
/// @throws Error if it is malformed or a size is not positive.
std::optional<Eigen::AlignedBox2d> ParseSvgViewBox(std::string_view text);

/// viewport_from_user: how a viewBox is placed in a viewport by preserveAspectRatio (empty: xMidYMid meet)
/// [SVG 1.1, 7.8]. @throws Error if preserveAspectRatio is malformed.
Eigen::Affine2d PlaceSvgViewBox(const Eigen::AlignedBox2d& view_box, const Eigen::AlignedBox2d& viewport,
                                std::string_view preserve_aspect_ratio);

}  // namespace daumier::render
