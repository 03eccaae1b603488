#pragma once
#include "core/error.h"
#include "core/parallel.h"
#include "eval/matrix_product.h"

#include <Eigen/Core>

#include <functional>
#include <span>

namespace daumier::eval {

/// Numbers of faces (or of their sketches), one row a face.
using FaceRows = RowMajorMatrix<float>;

inline std::span<const float> RowSpan(const FaceRows& rows, size_t row) {
  return {rows.data() + Eigen::Index(row) * rows.cols(), size_t(rows.cols())};
}

inline Eigen::Map<const Eigen::RowVectorXf> AsRow(std::span<const float> numbers) {
  return {numbers.data(), Eigen::Index(numbers.size())};
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

/// Row i holds the floats (a std::span or std::vector) of read(faces[i]). Reads no other face.
/// @throws Error if two faces differ in length.
template <class Reader>
FaceRows ReadRows(const Reader& read, std::span<const int> faces) {
  FaceRows rows;
  for (size_t row = 0; row < faces.size(); ++row) {
    const auto numbers = read(faces[row]);
    if (row == 0) rows.resize(Eigen::Index(faces.size()), Eigen::Index(numbers.size()));
    DAUMIER_CHECK(Eigen::Index(numbers.size()) == rows.cols(), "face {} has {} numbers, others have {}", faces[row],
                  numbers.size(), rows.cols());
    rows.row(Eigen::Index(row)) = AsRow(numbers);
  }
  return rows;
}

/// The coordinates x0 y0 z0 x1 ... of a face of a database.
using FaceReader = std::function<std::span<const float>(int face)>;

/// Mean of the given faces, summed in float64. Reads no other face. @throws Error if there is no face.
Eigen::RowVectorXf MeanFace(const FaceReader& vertices, std::span<const int> faces);

/// Rows without their mean.
struct CentredRows {
  FaceRows rows;
  Eigen::RowVectorXf mean;
};

/// Subtracts the mean of the rows, which is summed in float64, in place of rows that are moved in.
/// @throws Error if there is no row or a number is not finite.
CentredRows Centre(FaceRows rows);

}  // namespace daumier::eval
