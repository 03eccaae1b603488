#pragma once
#include "core/task.h"
#include "fitting/code_model.h"
#include "fitting/gauss_newton.h"

#include <Eigen/Cholesky>

#include <functional>
#include <vector>

namespace daumier::fitting {

struct MeshCodeOptions {
  int num_points = 500;  ///< Vertices that a step reads, evenly spaced; all of them are scored.
  double ridge = 1e-4;   ///< Weight of |c|^2 against the mean squared distance, cm^2.
  int steps = 8;         ///< At most.
};

struct MeshCode {
  Eigen::VectorXd code;          ///< M
  geometry::Points vertices;     ///< V x 3, of the code, cm.
  double mean_error_cm = 0;      ///< Mean distance of all vertices.
  std::vector<double> energies;  ///< At the start and after each step; never rises.
  double seconds = 0;            ///< By the clock.
};

/// Finds codes of meshes of the model's topology [Jung et al. 2022, eq. 1]: the minimum of
///   E(c) = 1/P sum_p |D(c)_p - g_p|^2 + ridge |c|^2
/// over P vertices p, from c = 0, by damped Gauss-Newton steps (Minimise); of a linear model in one. The derivative at 0
/// is computed once for all meshes: the first step of each is a linear encoder.
class MeshCoder {
 public:
  /// The model has to outlive it. @throws Error if a number of the options is not positive.
  explicit MeshCoder(const CodeModel& model, const MeshCodeOptions& options = {});

  /// target: V x 3, cm. @throws Error unless there are V vertices, all finite.
  Minimum Code(const geometry::Points& target) const;

 private:
  double Scale() const;

  const CodeModel& model_;
  const MeshCodeOptions options_;
  std::vector<int> points_;
  Eigen::VectorXd mean_;                ///< Of points_ under the code 0, divided by the square root of P,
  Eigen::MatrixXd derivative_;          ///< and their derivative there.
  Eigen::LLT<Eigen::MatrixXd> factor_;  ///< Of a linear model's normal equations.
};

/// One mesh: MeshCoder(model, options).Code(target), all vertices scored. @throws Error as MeshCoder.
MeshCode CodeOfMesh(const CodeModel& model, const geometry::Points& target, const MeshCodeOptions& options = {});

/// The codes of many meshes, a row a mesh, N x M: mesh(i), i = 0 .. count - 1, is V x 3, cm. `task` is cancelled between
/// meshes. @throws Error as MeshCoder; Cancelled.
Eigen::MatrixXd CodesOfMeshes(const CodeModel& model, int count, const std::function<geometry::Points(int)>& mesh,
                              const MeshCodeOptions& options = {}, const Task& task = {});

}  // namespace daumier::fitting
