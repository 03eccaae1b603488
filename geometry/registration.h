#pragma once
#include "core/options.h"
#include "geometry/alignment.h"
#include "geometry/detail_energy.h"
#include "geometry/mesh.h"

#include <vector>

namespace daumier::geometry {

struct RegistrationOptions {
  DetailOptions detail;
  int align_iterations = 10;
  int num_rounds = 10;
  int iterations = 4;
  int repair_iterations = 8;
  double stiffness_start = 1000;
  double stiffness_end = 0.5;
  double landmark_weight_start = 300;
  double landmark_weight_end = 0.5;
  double anchor_weight = 0.1;
  double max_angle = 60;
  double max_distance_start = 2.0;
  double max_distance_end = 0.5;

  template <class V>
  void Visit(V&& visit) {
    visit("detail", detail, Table{}, "What the template keeps of its shape.");
    visit("align_iterations", align_iterations, Range{1, 1000},
          "Iterations of the alignment, which uses the landmarks alone, before the rounds.");
    visit("num_rounds", num_rounds, Range{1, 100},
          "Number of rounds. Stiffness, landmark weight and distance limit change from the start value to the end "
          "value over the rounds.");
    visit("iterations", iterations, Range{1, 100}, "Closest-point iterations in a round.");
    visit("repair_iterations", repair_iterations, Range{0, 1000},
          "Largest number of iterations after the last round that repair flipped triangles; they stop once no triangle "
          "is flipped.");
    visit("stiffness_start", stiffness_start, Range{1e-3, 1e6},
          "Weight of the template's shape in the alignment and the first round; a closest point weighs 1.");
    visit("stiffness_end", stiffness_end, Range{1e-3, 1e6}, "Weight of the template's shape in the last round.");
    visit("landmark_weight_start", landmark_weight_start, Range{1e-6, 1e6},
          "Weight of a landmark in the alignment and the first round.");
    visit("landmark_weight_end", landmark_weight_end, Range{1e-6, 1e6}, "Weight of a landmark in the last round.");
    visit("anchor_weight", anchor_weight, Range{0.0, 1e6},
          "Weight that holds an anchor vertex (the border of the neck) in its place while it has no match.");
    visit("max_angle", max_angle, Range{0.0, 180.0},
          "Largest angle between the normals of corresponding points, degrees.");
    visit("max_distance_start", max_distance_start, Range{1e-6, 1e3},
          "Largest distance of corresponding points in the first round, cm of the template.");
    visit("max_distance_end", max_distance_end, Range{1e-6, 1e3},
          "Largest distance of corresponding points in the last round, cm of the template.");
  }
};

/// The surface that is brought onto others.
struct RegistrationTemplate {
  TriangleMesh mesh;
  std::vector<int> landmarks;        ///< L distinct vertices.
  Eigen::VectorXd landmark_weights;  ///< L, > 0: how far each is trusted; multiplies the options' weights.
  std::vector<int> anchors = {};     ///< Vertices that stay near their places where nothing matches them: the neck.
};

struct Registration {
  Points vertices;                  ///< V x 3, in the template's frame.
  Points aligned;                   ///< V x 3: the template after the alignment by landmarks alone.
  Similarity template_from_target;  ///< By the landmarks.
};

/// Brings a template onto a surface of any topology by non-rigid closest-point iterations [Amberg et al. 2007]: the
/// target comes into the template's frame by its landmarks; the template follows the landmarks with its details kept;
/// then, in rounds from stiff to soft,
///   x' = argmin stiffness E(x') + sum_v t_v |x'_v - c_v|^2 + sum_k w_k |x'_k - landmark_k|^2 + anchors,
/// E the DetailEnergy and c_v the match of vertex v (SurfaceMatcher); a vertex without a match (back of the head, ears,
/// nostrils) follows by E alone. Where a triangle of the template flips, the trust t_v (1 at first) in the matches
/// and landmarks around it is lowered, so that the surface smoothes itself out there.
/// Promises: a target equal to the template gives the template; a target that is moved by a similarity gives the same
/// vertices; the same input gives the same bytes. May be called from several threads at once.
class NonRigidRegistration {
 public:
  /// @throws Error if a landmark or an anchor is out of range or repeated, the weights are not one a landmark and
  /// positive, there are fewer than three landmarks, or as DetailEnergy.
  NonRigidRegistration(RegistrationTemplate source, const RegistrationOptions& options);

  /// landmark_targets: L x 3, in the target's frame. @throws Error if there are not L, one is not finite, they lie in
  /// one line, the system is singular (a part of the template has no landmark), or as TriangleTree.
  Registration Register(const TriangleMesh& target, const Points& landmark_targets) const;

  const RegistrationTemplate& source() const { return source_; }
  const RegistrationOptions& options() const { return options_; }

 private:
  RegistrationTemplate source_;
  RegistrationOptions options_;
  DetailEnergy energy_;
  std::vector<bool> is_anchor_;
};

}  // namespace daumier::geometry
