#pragma once
#include "core/options.h"
#include "core/task.h"
#include "faces/bilinear_model.h"
#include "faces/face_basis.h"

#include <Eigen/Core>

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace daumier::faces {

struct FaceGaussianOptions {
  int num_symmetric = 64;
  int num_asymmetric = 16;

  template <class V>
  void Visit(V&& visit) {
    visit("num_symmetric", num_symmetric, Range{1, 1000}, "Components of faces that are their own mirror image.");
    visit("num_asymmetric", num_asymmetric, Range{0, 1000}, "Components of what the two sides of faces differ by.");
  }
};

/// A normal distribution of faces by principal components [Sirovich 1987]: face = mean + sum_k c_k row_k, c ~ N(0, I).
struct FaceGaussian {
  Eigen::VectorXf mean;      ///< 3V, cm.
  BilinearModel::Core rows;  ///< K x 3V, orthogonal; a row is one standard deviation, cm.
  /// The first rows, greatest first, are their own mirror images; the others, greatest first, their negatives. Without
  /// a mirror map all rows count as symmetric.
  int num_symmetric = 0;

  int size() const { return int(rows.rows()); }
  int num_coordinates() const { return int(rows.cols()); }
};

/// The distribution of some faces and of their mirror images. face(i), i = 0 .. num_faces - 1: 3V coordinates. mirror:
/// of each vertex, as Annotation::mirror, with x changing its sign; empty: faces have no mirror images, and num_symmetric
/// components are fitted to them. Components that only rounding explains are left out. Signs are fixed: the entry of
/// largest magnitude of a row is positive. @throws Error if there is no face, or the mirror map has another size;
/// Cancelled if the task is.
FaceGaussian FitFaceGaussian(int num_faces, int num_coordinates, const std::function<std::span<const float>(int)>& face,
                             const std::vector<int>& mirror, const FaceGaussianOptions& options = {},
                             const Task& task = {});

/// The coefficients of the nearest face, K. @throws Error if `face` has another number of coordinates.
Eigen::VectorXf CoefficientsOf(const FaceGaussian& gaussian, std::span<const float> face);
/// 3V coordinates. @throws Error if the number of coefficients differs.
Eigen::VectorXf Reconstruct(const FaceGaussian& gaussian, const Eigen::VectorXf& coefficients);

/// An orthonormal basis of all faces of the Gaussian, K + 1 rows: what of the mean its rows do not show, then the rows,
/// each divided by its length. `deviation` is left empty.
FaceBasis BasisOf(const FaceGaussian& gaussian);

/// A Gaussian in terms of BasisOf.
struct GaussianOfBasis {
  Eigen::VectorXf mean;       ///< K + 1: coordinates of the mean.
  Eigen::VectorXf deviation;  ///< K: length of each row, cm.
  int num_symmetric = 0;
};
GaussianOfBasis InBasis(const FaceGaussian& gaussian, const FaceBasis& basis);
/// Undoes InBasis. @throws Error if sizes disagree.
FaceGaussian FromBasis(const GaussianOfBasis& gaussian, const FaceBasis& basis);

/// One safetensors file (docs/formats.md); atomic. Returns its checksum.
std::string WriteFaceGaussian(const std::filesystem::path& file, const FaceGaussian& gaussian);
/// @throws Error naming file and cause: missing, truncated, of a newer version, or shapes that do not belong together.
FaceGaussian ReadFaceGaussian(const std::filesystem::path& file);

}  // namespace daumier::faces
