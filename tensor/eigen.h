#pragma once
#include "core/error.h"
#include "tensor/shape.h"

#include <torch/types.h>
#include <Eigen/Core>

/// Between Eigen and LibTorch. Element types are float, double, int32_t and int64_t. Copies own their memory; views
/// share it.
namespace daumier::tensor {

template <class T>
using RowMajorMatrix = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The (rows, cols) tensor of a matrix, or (size) of a vector, without a copy: valid while `matrix` lives and keeps its
/// size. Row-major matrices give contiguous tensors, column-major ones strides (1, rows).
template <class Derived>
torch::Tensor ViewAsTensor(Eigen::PlainObjectBase<Derived>& matrix) {
  const auto type = c10::CppTypeToScalarType<typename Derived::Scalar>::value;
  if constexpr (Derived::IsVectorAtCompileTime) {
    return torch::from_blob(matrix.data(), {matrix.size()}, type);
  } else {
    const int64_t rows = matrix.rows(), cols = matrix.cols();
    if constexpr (Derived::IsRowMajor) return torch::from_blob(matrix.data(), {rows, cols}, type);
    return torch::from_blob(matrix.data(), {rows, cols}, {1, rows}, type);
  }
}

/// A contiguous copy of any Eigen expression: (rows, cols), or (size) for vectors.
template <class Derived>
torch::Tensor CopyToTensor(const Eigen::DenseBase<Derived>& expression) {
  using Scalar = typename Derived::Scalar;
  if constexpr (Derived::IsVectorAtCompileTime) {
    Eigen::Matrix<Scalar, Eigen::Dynamic, 1> vector = expression.derived().reshaped();
    return ViewAsTensor(vector).clone();
  } else {
    RowMajorMatrix<Scalar> matrix = expression.derived();
    return ViewAsTensor(matrix).clone();
  }
}

/// A (rows, cols) tensor as an Eigen matrix without a copy: valid while the tensor's memory lives.
/// @throws Error if the tensor is not two-dimensional, contiguous, on the CPU and of type T.
template <class T>
Eigen::Map<const RowMajorMatrix<T>> ViewAsMatrix(const torch::Tensor& tensor) {
  CheckShape(tensor, {kAny, kAny}, "tensor");
  DAUMIER_CHECK(
      tensor.is_contiguous() && tensor.device().is_cpu() && tensor.scalar_type() == c10::CppTypeToScalarType<T>::value,
      "only a contiguous tensor on the CPU of the requested element type can be viewed as a matrix; this one is {} on "
      "{}",
      c10::toString(tensor.scalar_type()), tensor.device().str());
  return {tensor.data_ptr<T>(), tensor.size(0), tensor.size(1)};
}

/// A copy of a (rows, cols) tensor of any layout, device and element type. @throws Error if it is not two-dimensional.
template <class T>
RowMajorMatrix<T> CopyToMatrix(const torch::Tensor& tensor) {
  const auto plain = tensor.detach().to(torch::kCPU, c10::CppTypeToScalarType<T>::value).contiguous();
  return ViewAsMatrix<T>(plain);
}

}  // namespace daumier::tensor
