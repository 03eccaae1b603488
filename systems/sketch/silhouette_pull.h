#pragma once
#include "faces/annotation.h"
#include "systems/sketch/view_selection.h"

#include <array>
#include <optional>
#include <vector>

/// Silhouettes that follow a drawn line [Nealen et al. 2005]. Lengths in a view are pixels of its camera.
namespace daumier::sketch {

/// A line on a surface, as a view shows it.
struct SurfaceLine {
  CanvasPoints points;                       ///< Pixels.
  std::vector<std::array<int, 2>> vertices;  ///< Of each point the mesh edge that it lies on, or one vertex twice.
  bool closed = false;                       ///< The last point is the first one again.
};

/// The occluding contours that a view shows, where the normal is perpendicular to the view's axis, cut where something
/// lies in front of them. @throws Error as VisibleSurface.
std::vector<SurfaceLine> VisibleSilhouettes(const geometry::TriangleMesh& mesh, const render::Camera& camera,
                                            const VisibleSurface& surface);

/// The silhouette that an annotation defines for a view: its feature curves of the kind silhouette (frontal: around
/// the face, across chin and forehead) or side_silhouette (the profile), joined at their nearest ends. projected: V x 3,
/// pixels in columns 0 and 1. Without points if the annotation has no such curve.
SurfaceLine DefinedSilhouette(const faces::Annotation& annotation, faces::View view, const geometry::Points& projected);

/// Vertices and how far they move in the plane of a view.
struct LinePull {
  std::vector<int> vertices;  ///< Ascending.
  Eigen::MatrixX2d moves;     ///< A row a vertex, pixels.
  double distance = 0;        ///< Of the line from the stroke, mean of its points, pixels.
};

/// The part of a line between the places that are nearest to the stroke's ends (of a closed line either part), each point
/// of it matched with the stroke by its share of the arc length, none farther than `reach` pixels; of all lines the one
/// whose points are nearest to theirs on average. Both vertices of a point's edge move as it does, a vertex of several
/// points by their mean. Nothing if no line is that near. @throws Error as CheckStroke.
std::optional<LinePull> PullToStroke(const std::vector<SurfaceLine>& lines, const CanvasPoints& stroke, double reach);

}  // namespace daumier::sketch
