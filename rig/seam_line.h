#pragma once
#include "rig/face_sides.h"
#include "rig/head_surface.h"

namespace daumier::rig {

/// The line on which the sides of a slit meet, as heights over the way from corner to corner.
struct SeamLine {
  SeamFrame frame;
  geometry::Vector3 origin;  ///< The right corner.
  double width = 0;          ///< cm, from corner to corner.
  Eigen::VectorXd heights;   ///< At equal steps along the width.
  Eigen::VectorXd depths;    ///< Likewise: out of the skin.

  /// Along, up and out, from the right corner.
  geometry::Vector3 Coordinates(const geometry::Vector3& point) const;
  /// At a place along the width; beyond the corners that of the corner.
  double HeightAt(double along) const;
  double DepthAt(double along) const;
};

/// The middle between the edges of a slit of a registered template.
SeamLine MiddleOfSlit(const SeamEdges& edges, const geometry::Points& registered);

/// How far a line is drawn to a groove, in widths.
inline constexpr double kGrooveReach = 0.07;

/// Draws a line to the groove of the head that runs along it: the path from corner to corner, at most kGrooveReach off, that
/// maximises the mean concavity of the surface, less what it costs to leave the line and to turn. On a surface
/// without a groove the line stays.
void DrawToGroove(const HeadSurface& head, SeamLine& line);

}  // namespace daumier::rig
