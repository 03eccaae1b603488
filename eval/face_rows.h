#pragma once
#include "core/parallel.h"

#include <Eigen/Core>

#include <span>

namespace daumier::eval {

/// Faces (or coordinates), row a face.
using FaceRows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

inline std::span<const float> RowSpan(const FaceRows& rows, size_t row) {
  return {rows.data() + Eigen::Index(row) * rows.cols(), size_t(rows.cols())};
}

/// Row i holds the num_coordinates floats (a std::vector or an Eigen vector) of work(i), which is called on all cores.
template <class Work>
FaceRows RowsOnAllCores(size_t num_rows, Eigen::Index num_coordinates, const Work& work) {
  FaceRows rows(Eigen::Index(num_rows), num_coordinates);
  Eigen::Index next = 0;
  ForEachInOrder(int(num_rows), work, [&](const auto& face) {
    rows.row(next++) = Eigen::Map<const Eigen::RowVectorXf>(face.data(), num_coordinates);
  });
  return rows;
}

}  // namespace daumier::eval
