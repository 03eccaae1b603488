#pragma once
#include "core/options.h"

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

/// The tensor to be fitted, read face by face: 3V coordinates of (identity, expression), or an empty span where that face is
/// held out. Called several times a face.
using FaceReader = std::function<std::span<const float>(int identity, int expression)>;

/// Truncated N-mode SVD [De Lathauwer et al. 2000] of the 3V x I x E tensor through the Gram matrices of its identity and
/// expression modes; at most one block of faces is in memory at once. A face that is held out is imputed by
/// mean_i + mean_e - mean over the faces that are there. Signs are fixed (largest entry of a factor column is positive).
/// @throws Error if a mode is smaller than its rank, or an identity or an expression has no face at all.
BilinearModel FitBilinear(int num_identities, int num_expressions, int num_coordinates, const FaceReader& face,
                          const BilinearOptions& options);

/// 3V coordinates. @throws Error if u or v has the wrong length.
Eigen::VectorXf Reconstruct(const BilinearModel& model, const Eigen::VectorXf& u, const Eigen::VectorXf& v);

struct BilinearProjection {
  Eigen::VectorXf u, v;
  Eigen::VectorXf vertices;  ///< Reconstruct(model, u, v)
};

/// The u and v nearest to a face in the least-squares sense over `weights` (3V, or empty for ones), by alternating solves from
/// the fitted expression whose start is best. Keeps G = C W C^T, so that one projection costs no product with the core beyond C W g.
class BilinearProjector {
 public:
  explicit BilinearProjector(const BilinearModel& model, const Eigen::VectorXf& coordinate_weights = {});
  BilinearProjection Project(std::span<const float> face) const;

 private:
  const BilinearModel* model_;
  Eigen::VectorXf weights_;
  Eigen::MatrixXd gram_;
};

/// One safetensors file; atomic. Returns its checksum.
std::string WriteBilinearModel(const std::filesystem::path& file, const BilinearModel& model);
BilinearModel ReadBilinearModel(const std::filesystem::path& file);

}  // namespace daumier::faces
