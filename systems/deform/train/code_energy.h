#pragma once
#include "systems/deform/train/network.h"

#include <torch/types.h>
#include <Eigen/Core>

#include <optional>
#include <span>
#include <vector>

namespace daumier::deform {

/// weight / 3N sum_i |D(z, p_i) - g_i|^2 over N points of a whole surface [Jung et al. 2022, eq. 1]. The mean is over
/// coordinates, as in the authors' program; the printed sum is three times that.
struct AllPointsTerm {
  SurfacePoints points;   ///< N points p_i.
  torch::Tensor targets;  ///< (N, 3) g_i, model units.
  double weight = 3e3;
};

/// weight / 3P sum_i w_i |D(z, p_i) - g_i|^2 over P points, as handles of an edit. With all weights 1 and the points of
/// an AllPointsTerm it is that term.
struct SparsePointsTerm {
  SurfacePoints points;   ///< P points p_i.
  torch::Tensor targets;  ///< (P, 3) g_i, model units.
  torch::Tensor weights;  ///< (P) w_i >= 0.
  double weight = 3e3;
};

/// weight / M |z - mean|^2.
struct CodePrior {
  std::optional<torch::Tensor> mean;  ///< (M); absent: 0.
  double weight = 1e6;
};

/// E(z), the sum of its terms.
struct CodeEnergy {
  std::optional<AllPointsTerm> all_points;
  std::vector<SparsePointsTerm> sparse_points;
  CodePrior prior;
};

/// Points at vertices of the network's template, for a SparsePointsTerm.
/// @throws Error if there is no such vertex.
SurfacePoints VertexPoints(const DeformNetwork& network, std::span<const int> vertices);

/// E and its terms at one code, weights included.
struct CodeEnergyValue {
  double energy = 0;
  double all_points = 0;              ///< 0 if absent.
  std::vector<double> sparse_points;  ///< A number a term.
  double prior = 0;
  double mean_square = 0;  ///< Mean over the 3N coordinates of squared distance of all_points; 0 if absent.
  torch::Tensor gradient;  ///< (M) dE/dz.
};

/// E as a function of the code. Sums are in float64; positions in the type of the network's template.
class CodeObjective {
 public:
  /// The network has to outlive it.
  /// @throws Error if a shape disagrees, a term has no point, a number is not finite, or a weight is below 0.
  CodeObjective(DeformNetwork& network, CodeEnergy energy);

  /// @throws Error if the shape disagrees.
  CodeEnergyValue At(const torch::Tensor& code) const;
  /// Half the second derivatives without those of D (Gauss-Newton), M x M:
  ///   weight / 3S J^T J of all_points + weight / 3P J^T W J of each sparse term + weight / M of the prior.
  /// rows: (S) int64, the points that represent all of all_points; ignored if that is absent. J by forward differences
  /// of the code. Does not depend on targets but through the code.
  Eigen::MatrixXd HalfHessian(const torch::Tensor& code, const torch::Tensor& rows) const;
  /// Other targets (P, 3) of a sparse term. @throws Error if there is no such term, or as the constructor.
  void MoveTargets(size_t sparse_term, const torch::Tensor& targets);

  /// (M) zeros, of the type and on the device of the template: the default start of a fit.
  torch::Tensor Zero() const;
  int64_t num_numbers() const { return network_.options().latent; }
  /// Of all_points; 0 if absent.
  int64_t num_points() const { return energy_.all_points ? energy_.all_points->targets.size(0) : 0; }
  const CodeEnergy& energy() const { return energy_; }

 private:
  DeformNetwork& network_;
  CodeEnergy energy_;
  SurfacePoints sparse_;  ///< The points of all sparse terms, one after the other.
  SurfacePoints points_;  ///< Those of all_points, then sparse_.
};

}  // namespace daumier::deform
