#pragma once
#include "render/image.h"

#include <Eigen/Core>

#include <array>
#include <limits>
#include <vector>

namespace daumier::render {

/// The end of a line or a junction of lines.
struct SkeletonNode {
  Eigen::Vector2d position;  ///< Pixels: x right, y down; the centre of the first pixel is (0.5, 0.5).
  double radius;             ///< Distance from there to the edge of the ink.
};

/// A line between two nodes; they are one where the line is closed. A dot is an edge of one point, its node twice.
struct SkeletonEdge {
  std::array<int, 2> nodes;
  std::vector<Eigen::Vector2d> points;  ///< From the first node to the second, their positions included.

  double Length() const;
};

/// The lines of a skeleton.
struct SkeletonGraph {
  std::vector<SkeletonNode> nodes;
  std::vector<SkeletonEdge> edges;

  /// How many ends of edges meet in each node.
  std::vector<int> Degrees() const;
};

/// The graph of a skeleton from Thin(ink): pixels with one or no neighbour are ends, connected pixels with three or
/// more are one junction each, and a closed line without junctions has one node somewhere on it.
/// @throws Error if the skeleton has another size than the ink.
SkeletonGraph GraphOfSkeleton(const Image& skeleton, const Image& ink);

/// Without what thinning adds to the lines of a pen: spurs (loose ends shorter than the line that they come from is
/// wide) and bridges (junctions nearer to each other than the lines are wide, where lines cross at a small angle), each
/// of which becomes one junction. Closed lines shorter than twice that width go too. Spurs stay whose ink protrudes from
/// the disc of their junction by more than max_protrusion of its radii, where two lines of a wide pen make a sharp
/// corner: at the corner of a line that is cut straight it is 0.42.
SkeletonGraph WithoutThinningArtefacts(SkeletonGraph graph,
                                       double max_protrusion = std::numeric_limits<double>::infinity());

}  // namespace daumier::render
