#pragma once
#include "faces/hole_closure.h"
#include "geometry/level_cut.h"

#include <vector>

namespace daumier::faces {

/// Cuts a head's ragged border off along a smooth loop. In the frame of the border's best plane, which has the heights
/// z(angle) over it, the cut runs at
///   a_0 + sum_{k = 1..3} (a_k cos k angle + b_k sin k angle) - d,
/// the least-squares fit of the border's heights, and d so that the cut is 0.3 of the border's mean edge within its
/// innermost vertex: what is removed is what is connected to the border beyond that. Nothing is removed if the cut would
/// take away a vertex of `kept`, change the number of holes, or if d were more than four mean edges.
/// `border`: as geometry::BoundaryLoops gives it. @throws Error as geometry::CutPositive.
geometry::LevelCut CutBorder(const geometry::TriangleMesh& neutral, const std::vector<int>& border,
                             const std::vector<int>& kept);

/// A closed curve of edge points on a face, moved from where it is on the neutral one by a smoothed displacement: an
/// expression may move the vertices at both sides of a cut by uneven amounts. Six times, each displacement is averaged
/// with what its two neighbours have, linearly in the neutral curve's length, at its place. Both N x 3, cm. The neutral
/// curve, moved or not, stays as it is.
geometry::Points SmoothlyMoved(const geometry::Points& neutral_loop, const geometry::Points& loop);

/// Rings of the cap of a neck (HoleClosure::num_rings).
inline constexpr int kCapRings = 4;

/// Positions of the own vertices of a cap, num_vertices() x 3: its rim is rounded outwards, its middle is flat. Rings are
/// the loop scaled about its centre, flattened and moved along its normal, that of its area vector.
geometry::Points CapPoints(const geometry::Points& loop);

}  // namespace daumier::faces
