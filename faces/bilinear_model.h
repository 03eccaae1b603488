#pragma once
#include "core/options.h"

#include <Eigen/Cholesky>
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
/// imputed by a_i + b_e, the additive model that is nearest to the faces that are there in the least-squares sense
/// (without holes: mean_i + mean_e - mean). Signs are fixed: the entry of largest magnitude of a factor column is
/// positive. The result does not depend on the number of threads.
/// @throws Error if a mode is smaller than its rank, an identity or an expression has no face at all, or a face has
/// another size.
BilinearModel FitBilinear(int num_identities, int num_expressions, int num_coordinates, const FaceReader& face,
                          const BilinearOptions& options);

/// 3V coordinates. @throws Error if u or v has the wrong length.
Eigen::VectorXf Reconstruct(const BilinearModel& model, const Eigen::VectorXf& u, const Eigen::VectorXf& v);

struct BilinearProjection {
  Eigen::VectorXf u, v;
  Eigen::VectorXf vertices;  ///< Reconstruct(model, u, v)
};

/// The u and v nearest to a face in the least-squares sense over `weights` (3V, >= 0, or empty for ones), by
/// alternating solves from the fitted expression whose start is best. The free scale between u and v is set so that v
/// is as long as that expression and points to its side. Keeps G = C W C^T, so that one projection costs no product
/// with the core beyond C W g. Keeps a reference to `model`. @throws Error if the weights or a face have another size.
class BilinearProjector {
 public:
  explicit BilinearProjector(const BilinearModel& model, const Eigen::VectorXf& coordinate_weights = {});
  BilinearProjection Project(std::span<const float> face) const;

 private:
  Eigen::MatrixXd IdentityGram(const Eigen::VectorXd& v) const;
  Eigen::MatrixXd ExpressionGram(const Eigen::VectorXd& u) const;

  const BilinearModel* model_;
  Eigen::VectorXd weights_;
  Eigen::MatrixXd gram_;
  std::vector<Eigen::LDLT<Eigen::MatrixXd>> starts_;  ///< Of IdentityGram(v), one a fitted expression.
};

/// One safetensors file (docs/formats.md); atomic. Returns its checksum.
std::string WriteBilinearModel(const std::filesystem::path& file, const BilinearModel& model);
/// @throws Error naming file and cause: missing, truncated, of a newer version, or shapes that do not belong together.
BilinearModel ReadBilinearModel(const std::filesystem::path& file);

}  // namespace daumier::faces
