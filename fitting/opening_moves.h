#pragma once
#include "fitting/label_curves.h"
#include "geometry/mesh.h"

#include <optional>
#include <vector>

namespace daumier::fitting {

/// Gaps of an opening, cm: y of the upper line minus that of the lower, one of each pair. Negative: the lines cross.
Eigen::VectorXd GapsOf(const OpeningPairs& opening, const geometry::Points& vertices);

/// How far the lines of an opening shall be from each other.
struct GapGoal {
  bool closed = false;
  double least_middle_cm = 0;  ///< Where not closed: of the middle.
};
/// Towards the corners 4 s (1 - s) of the middle's, s = GapPair::share.
double LeastGap(const GapGoal& goal, double share);

/// Closes or opens mouth and eyes of a face and uncrosses their lines: the least move of the two lines that reaches the
/// goal, and of the skin about them, which follows by (1 - (d / reach)^2)^2, d the length along mesh edges to the line
/// on the neutral face. Lips share a move in halves; of lids the upper one alone moves, since it is the one that does.
class OpeningMover {
 public:
  /// @throws Error if a reach is not positive.
  OpeningMover(const faces::FaceTemplate& face_template, std::vector<OpeningPairs> openings, double lip_reach_cm = 1.5,
               double lid_reach_cm = 1.5);

  const std::vector<OpeningPairs>& openings() const { return openings_; }

  /// Opening i of openings(). Where closed, lips are 0 to 0.5 mm apart and lids meet, in depth too, within 0.1 mm. Where
  /// the goal holds, nothing moves.
  void Reach(const GapGoal& goal, size_t opening, geometry::Points& vertices) const;

 private:
  struct Follower {
    int vertex;
    int leader;  ///< Position on the line.
    double share;
  };
  struct Lines {
    std::vector<Follower> upper, lower;
  };
  std::vector<OpeningPairs> openings_;
  std::vector<Lines> followers_;
};

}  // namespace daumier::fitting
