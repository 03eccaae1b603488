#pragma once
#include "core/task.h"
#include "fitting/code_model.h"

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

/// The code of a mesh of the model's topology [Jung et al. 2022, eq. 1]:
///   E(c) = 1/P sum_p |D(c)_p - g_p|^2 + ridge |c|^2
/// over P vertices p, from c = 0, by damped Gauss-Newton steps; the derivative is computed again only where a step with
/// the last one lowers E by less than half of what it predicts, and for a linear model once. target: V x 3, cm.
/// @throws Error unless there are V vertices, all finite, or if a number of the options is not positive.
MeshCode CodeOfMesh(const CodeModel& model, const geometry::Points& target, const MeshCodeOptions& options = {});

/// The codes of many meshes, a row a mesh, N x M: mesh(i), i = 0 .. count - 1, is V x 3, cm. Of a linear model the
/// minimum itself, by one factorisation for all. `task` is cancelled between meshes. @throws Error as CodeOfMesh;
/// Cancelled.
Eigen::MatrixXd CodesOfMeshes(const CodeModel& model, int count, const std::function<geometry::Points(int)>& mesh,
                              const MeshCodeOptions& options = {}, const Task& task = {});

}  // namespace daumier::fitting
