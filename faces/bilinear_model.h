#pragma once
#include "core/options.h"
#include "core/task.h"

#include <Eigen/Core>

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace daumier::faces {

struct BilinearOptions {
  int num_identity = 50;
  int num_expression = 16;

  template <class V>
  void Visit(V&& visit) {
    visit("num_identity", num_identity, Range{1, 1000}, "Length of u, the identity weights.");
    visit("num_expression", num_expression, Range{1, 1000}, "Length of v, the expression weights.");
  }
};

/// Bilinear face [Han et al. 2017, eq. 1; Cao et al. 2014]: V = C x2 u^T x3 v^T, that is
///   coordinate_m = sum_k sum_l C(k * num_expression + l, m) u_k v_l.
struct BilinearModel {
  using Core = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  int num_identity = 0;                ///< Ku
  int num_expression = 0;              ///< Kv
  Core core;                           ///< (Ku * Kv) x 3V in cm
  Eigen::MatrixXf identity_factors;    ///< I x Ku: u of every fitted identity (person x level)
  Eigen::MatrixXf expression_factors;  ///< E x Kv: v of every fitted expression

  int num_coordinates() const { return static_cast<int>(core.cols()); }
};

/// The tensor to be fitted, read face by face: 3V coordinates of (identity, expression), or an empty span where that
/// face is held out. Called several times a face, from several threads at once; a face stays the same between the
/// calls.
using FaceReader = std::function<std::span<const float>(int identity, int expression)>;

/// Truncated N-mode SVD [De Lathauwer et al. 2000] of the 3V x I x E tensor through the Gram matrices of its identity
/// and expression modes. Memory stays flat: blocks of coordinates of at most 64 MB a thread. A face that is held out is
/// imputed by a_i + b_e, the additive model that is nearest to the present faces in the least-squares sense
/// (without holes: mean_i + mean_e - mean). Signs are fixed: the entry of largest magnitude of a factor column is
/// positive. The result does not depend on the number of threads.
/// @throws Error if a mode is smaller than its rank, an identity or an expression has no face at all, or a face has
/// another size; Cancelled if the task is.
BilinearModel FitBilinear(int num_identities, int num_expressions, int num_coordinates, const FaceReader& face,
                          const BilinearOptions& options, const Task& task = {});

/// 3V coordinates. @throws Error if u or v has the wrong length.
Eigen::VectorXf Reconstruct(const BilinearModel& model, const Eigen::VectorXf& u, const Eigen::VectorXf& v);

/// One safetensors file (docs/formats.md); atomic. Returns its checksum.
std::string WriteBilinearModel(const std::filesystem::path& file, const BilinearModel& model);
/// @throws Error naming file and cause: missing, truncated, of a newer version, or shapes that do not belong together.
BilinearModel ReadBilinearModel(const std::filesystem::path& file);

}  // namespace daumier::faces
