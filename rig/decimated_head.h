#pragma once
#include "rig/rigged_head.h"

#include <string>

namespace daumier::rig {

/// Which poses decide what a collapse costs.
enum class DecimatedPoses { kNeutral, kAll };

/// A rigged head of fewer triangles.
struct DecimatedHead {
  RiggedHead head;
  int num_triangles_before = 0, num_triangles = 0;  ///< With those of its eyes.
  bool is_reached = true;                           ///< Whether at most the required number is left.
  /// The greatest loss of a target's peak, the largest displacement of a vertex in use, as a share of it, and that target;
  /// no name if none lost anything.
  double greatest_peak_loss = 0;
  std::string worst_target;
};

/// Of the head and its eyes.
int NumTriangles(const RiggedHead& head);

/// At most `num_triangles` triangles by geometry::Decimate, over the neutral pose and each target at weight 1; of heads of many
/// vertices the largest targets alone, at most `most_posed_vertices` / V of them, as each vertex takes 52 bytes a pose. The eyes are
/// part of the same budget: the order of errors decides where triangles vanish. What is mostly hidden counts less: inside
/// of the mouth, teeth and tongue 0.3 of an equal error of the skin, the backs of eyeballs 0.03. Of each target the vertex
/// that moves most stays, so that its peak is unchanged. Vertices that remain keep place, displacements and UV; borders of
/// materials, seams of UV and open edges are kept. Vertices without a triangle are removed, the others keep their order, so do
/// triangles. A head that has no more triangles than that is unchanged. kNeutral: the neutral pose alone, and no peaks.
/// @throws Error as geometry::Decimate.
DecimatedHead Decimated(const RiggedHead& head, int num_triangles, DecimatedPoses poses = DecimatedPoses::kAll,
                        Eigen::Index most_posed_vertices = 6'000'000);

}  // namespace daumier::rig
