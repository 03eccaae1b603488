#pragma once
#include "geometry/mesh.h"

#include <Eigen/Core>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace daumier::faces {

/// An array of numbers of an external file as stored there (little-endian), converted on access.
class NumberArray {
 public:
  enum class Type { kI8, kU8, kI16, kU16, kI32, kU32, kI64, kU64, kF32, kF64 };
  enum class Order { kRowMajor, kColumnMajor };

  static size_t ItemSize(Type type);
  /// Product of the sizes times ItemSize. @throws Error naming `name` if a size is negative or the product too large.
  static size_t NumBytes(Type type, const std::vector<int64_t>& shape, const std::string& name);

  NumberArray() = default;
  /// `name` names the array in messages: "model.npz: f". @throws Error if the bytes do not fill the shape.
  NumberArray(Type type, std::vector<int64_t> shape, Order order, std::string bytes, std::string name);

  const std::string& name() const { return name_; }
  const std::vector<int64_t>& shape() const { return shape_; }
  int64_t size() const { return size_; }
  /// The shape without sizes of 1, since files disagree on whether a vector is a row, a column or neither.
  std::vector<int64_t> squeezed() const;

  /// The element of a row-major index.
  double operator[](int64_t index) const;

  /// `rows` x `columns` (-1: any) of the elements in row-major order: the first size is the rows, the rest the columns,
  /// as a reshape would have it. @throws Error naming the array if it cannot have that shape.
  Eigen::MatrixXf Matrix(int64_t rows, int64_t columns) const;
  /// All elements, one after the other. @throws Error if there are not `size` (-1: any).
  Eigen::VectorXf Vector(int64_t size = -1) const;
  /// V x 3 out of (V, 3), or of 3V numbers x0 y0 z0 x1 ... @throws Error if it is neither, or not finite.
  geometry::Points Points() const;
  /// `vertices` with polygons from the rows of (F, 3) or (F, 4), whole numbers counted from `first`.
  /// @throws Error if it is not that, or a corner is no vertex.
  geometry::PolygonMesh Polygons(int first, geometry::Points vertices) const;
  /// The same elements with the sizes in reverse order.
  NumberArray Transposed() const;

 private:
  double At(size_t item) const;

  Type type_ = Type::kF32;
  std::vector<int64_t> shape_;
  Order order_ = Order::kRowMajor;
  std::string bytes_, name_;
  int64_t size_ = 0;
};

/// The arrays of a file by name.
using NumberArrays = std::map<std::string, NumberArray>;

/// @throws Error naming the file, the array that is missing and those of the file.
const NumberArray& ArrayOf(const NumberArrays& arrays, const std::string& name, const std::string& file);

}  // namespace daumier::faces
