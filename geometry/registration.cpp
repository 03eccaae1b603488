#include "geometry/registration.h"

#include "core/error.h"
#include "geometry/flips.h"
#include "geometry/normals.h"
#include "geometry/surface_matcher.h"
#include "geometry/topology.h"

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>

namespace daumier::geometry {
namespace {

/// Factors of the weight of a match, per iteration, at a corner of a flipped triangle and at a neighbour of one.
constexpr double kCornerTrust = 0.5, kNeighbourTrust = 0.8;
/// The least pivot, as a share of the largest, of a system that is not singular.
constexpr double kLeastMatchPivot = 1e-12;

/// From start (share 0) to end (share 1) in equal ratios.
double Between(double start, double end, double share) {
  return start * std::pow(end / start, share);
}

/// Marks vertices. @throws Error if one is out of range or comes twice.
std::vector<bool> Mark(const std::vector<int>& vertices, int num_vertices, const char* what) {
  std::vector<bool> is_marked(num_vertices, false);
  for (const int v : vertices) {
    DAUMIER_CHECK(v >= 0 && v < num_vertices, "{} {} is out of range, there are {} vertices", what, v, num_vertices);
    DAUMIER_CHECK(!is_marked[v], "vertex {} is {} twice", v, what);
    is_marked[v] = true;
  }
  return is_marked;
}

/// sum_v weights_v |x_v - targets_v|^2, as what it adds to a linear system.
struct Springs {
  Eigen::VectorXd weights;
  Points pull;  ///< weights * targets

  explicit Springs(Eigen::Index num_vertices)
      : weights(Eigen::VectorXd::Zero(num_vertices)), pull(Points::Zero(num_vertices, 3)) {}
  void Add(int v, double weight, const Eigen::RowVector3d& target) {
    weights[v] += weight;
    pull.row(v) += weight * target;
  }
};

/// One system after another with the same pattern.
class Solver {
 public:
  explicit Solver(const DetailEnergy& energy) : energy_(energy) { factor_.analyzePattern(energy.matrix()); }

  Points Solve(double stiffness, const Points& now, const Springs& springs) {
    SparseMatrix system = stiffness * energy_.matrix();
    system.diagonal() += springs.weights;
    factor_.factorize(system);
    const bool is_regular = factor_.info() == Eigen::Success &&
                            factor_.vectorD().minCoeff() > kLeastMatchPivot * factor_.vectorD().maxCoeff();
    DAUMIER_CHECK(is_regular, "the registration is singular: a part of the template has no landmark");
    const Points rhs = stiffness * energy_.Pull(now) + springs.pull;
    return factor_.solve(rhs);
  }

 private:
  const DetailEnergy& energy_;
  Eigen::SimplicialLDLT<SparseMatrix> factor_;
};

}  // namespace

NonRigidRegistration::NonRigidRegistration(RegistrationTemplate source, const RegistrationOptions& options)
    : source_(std::move(source)), options_(options), energy_(source_.mesh, options.detail) {
  const int num_vertices = static_cast<int>(source_.mesh.vertices.rows());
  Mark(source_.landmarks, num_vertices, "a landmark");
  is_anchor_ = Mark(source_.anchors, num_vertices, "an anchor");
  DAUMIER_CHECK(source_.landmarks.size() >= 3, "{} landmarks; three or more are needed", source_.landmarks.size());
  DAUMIER_CHECK(source_.landmark_weights.size() == static_cast<Eigen::Index>(source_.landmarks.size()) &&
                    source_.landmark_weights.minCoeff() > 0,
                "{} weights for {} landmarks, expected one each, above 0", source_.landmark_weights.size(),
                source_.landmarks.size());
}

Registration NonRigidRegistration::Register(const TriangleMesh& target, const Points& landmark_targets) const {
  const std::vector<int>& ids = source_.landmarks;
  DAUMIER_CHECK(landmark_targets.rows() == static_cast<Eigen::Index>(ids.size()),
                "{} landmarks on the target, expected {}", landmark_targets.rows(), ids.size());
  DAUMIER_CHECK(landmark_targets.allFinite(), "a landmark on the target is not finite");
  const Points& rest = source_.mesh.vertices;
  const int num_vertices = static_cast<int>(rest.rows());
  Registration result;
  result.template_from_target = AlignSimilarity(landmark_targets, rest(ids, Eigen::all), source_.landmark_weights);
  const Points landmarks = result.template_from_target.Apply(landmark_targets);
  const SurfaceMatcher matcher({result.template_from_target.Apply(target.vertices), target.triangles});

  Eigen::VectorXd trust = Eigen::VectorXd::Ones(num_vertices);
  const auto pull_landmarks = [&](double weight, Springs& springs) {
    for (size_t k = 0; k < ids.size(); ++k) {
      const auto row = static_cast<Eigen::Index>(k);
      springs.Add(ids[k], trust[ids[k]] * weight * source_.landmark_weights[row], landmarks.row(row));
    }
  };
  const auto anchor = [&](int v, Springs& springs) {
    if (is_anchor_[v]) springs.Add(v, options_.anchor_weight, rest.row(v));
  };

  Solver solver(energy_);
  Springs alignment(num_vertices);
  pull_landmarks(options_.landmark_weight_start, alignment);
  for (int v = 0; v < num_vertices; ++v) anchor(v, alignment);
  Points now = rest;
  for (int i = 0; i < options_.align_iterations; ++i) now = solver.Solve(options_.stiffness_start, now, alignment);
  result.aligned = now;

  const Adjacency neighbours = VertexNeighbours(source_.mesh.triangles, num_vertices);
  const int num_iterations = options_.num_rounds * options_.iterations;
  for (int i = 0; i < num_iterations + options_.repair_iterations; ++i) {
    const int round = std::min(i / options_.iterations, options_.num_rounds - 1);
    const double share = options_.num_rounds > 1 ? double(round) / (options_.num_rounds - 1) : 1.0;
    const MatchLimits limits{Between(options_.max_distance_start, options_.max_distance_end, share),
                             options_.max_angle};
    const Points normals = VertexNormals({now, source_.mesh.triangles});
    Springs springs(num_vertices);
    pull_landmarks(Between(options_.landmark_weight_start, options_.landmark_weight_end, share), springs);
    for (int v = 0; v < num_vertices; ++v) {
      if (const auto match = matcher.Match(now.row(v), normals.row(v), limits)) {
        springs.Add(v, trust[v], match->position.transpose());
      } else {
        anchor(v, springs);
      }
    }
    now = solver.Solve(Between(options_.stiffness_start, options_.stiffness_end, share), now, springs);
    const std::vector<int> flipped = FlippedTriangles(rest, now, source_.mesh.triangles);
    if (flipped.empty() && i + 1 >= num_iterations) break;
    for (const int f : flipped) {
      for (const int v : source_.mesh.triangles.row(f)) {
        trust[v] *= kCornerTrust;
        for (const int other : neighbours[v]) trust[other] *= kNeighbourTrust;
      }
    }
  }
  result.vertices = now;
  return result;
}

}  // namespace daumier::geometry
