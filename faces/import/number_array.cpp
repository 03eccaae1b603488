#include "faces/import/number_array.h"

#include "core/error.h"

#include <cmath>
#include <cstring>
#include <limits>

namespace daumier::faces {

namespace {

template <class T>
double Load(const char* bytes, size_t item) {
  T value;
  std::memcpy(&value, bytes + item * sizeof(T), sizeof(T));
  return static_cast<double>(value);
}

}  // namespace

size_t NumberArray::ItemSize(Type type) {
  switch (type) {
    case Type::kI8:
    case Type::kU8:
      return 1;
    case Type::kI16:
    case Type::kU16:
      return 2;
    case Type::kI32:
    case Type::kU32:
    case Type::kF32:
      return 4;
    default:
      return 8;
  }
}

size_t NumberArray::NumBytes(Type type, const std::vector<int64_t>& shape, const std::string& name) {
  constexpr int64_t kLargest = std::numeric_limits<int64_t>::max() / 8;
  int64_t count = 1;
  for (const int64_t size : shape) {
    DAUMIER_CHECK(size >= 0 && (size == 0 || count <= kLargest / size), "{}: impossible shape ({})", name,
                  fmt::join(shape, ", "));
    count *= size;
  }
  return static_cast<size_t>(count) * ItemSize(type);
}

NumberArray::NumberArray(Type type, std::vector<int64_t> shape, Order order, std::string bytes, std::string name)
    : type_(type), shape_(std::move(shape)), order_(order), bytes_(std::move(bytes)), name_(std::move(name)) {
  const size_t needed = NumBytes(type_, shape_, name_);
  DAUMIER_CHECK(bytes_.size() == needed, "{}: {} bytes, its shape ({}) needs {}", name_, bytes_.size(),
                fmt::join(shape_, ", "), needed);
  size_ = static_cast<int64_t>(needed / ItemSize(type_));
}

std::vector<int64_t> NumberArray::squeezed() const {
  std::vector<int64_t> sizes;
  for (const int64_t size : shape_) {
    if (size != 1) sizes.push_back(size);
  }
  return sizes;
}

double NumberArray::At(size_t item) const {
  const char* const bytes = bytes_.data();
  switch (type_) {
    case Type::kI8:
      return Load<int8_t>(bytes, item);
    case Type::kU8:
      return Load<uint8_t>(bytes, item);
    case Type::kI16:
      return Load<int16_t>(bytes, item);
    case Type::kU16:
      return Load<uint16_t>(bytes, item);
    case Type::kI32:
      return Load<int32_t>(bytes, item);
    case Type::kU32:
      return Load<uint32_t>(bytes, item);
    case Type::kI64:
      return Load<int64_t>(bytes, item);
    case Type::kU64:
      return Load<uint64_t>(bytes, item);
    case Type::kF32:
      return Load<float>(bytes, item);
    case Type::kF64:
      return Load<double>(bytes, item);
  }
  throw Error(fmt::format("{}: unknown element type", name_));
}

double NumberArray::operator[](int64_t index) const {
  DAUMIER_CHECK(index >= 0 && index < size_, "{}: element {} of {}", name_, index, size_);
  if (order_ == Order::kRowMajor) return At(static_cast<size_t>(index));
  int64_t item = 0, stride = size_;
  for (size_t k = shape_.size(); k-- > 0;) {
    stride /= shape_[k];
    item += index % shape_[k] * stride;
    index /= shape_[k];
  }
  return At(static_cast<size_t>(item));
}

Eigen::MatrixXf NumberArray::Matrix(int64_t rows, int64_t columns) const {
  const int64_t first = shape_.empty() ? 1 : shape_.front();
  if (rows < 0) rows = columns > 0 ? size_ / columns : first;
  if (columns < 0) columns = rows > 0 ? size_ / rows : 0;
  DAUMIER_CHECK(rows > 0 && columns > 0 && columns <= size_ / rows && rows * columns == size_,
                "{} has the shape ({}), expected {} x {}", name_, fmt::join(shape_, ", "), rows, columns);
  Eigen::MatrixXf matrix(rows, columns);
  for (int64_t row = 0; row < rows; ++row) {
    for (int64_t column = 0; column < columns; ++column)
      matrix(row, column) = static_cast<float>((*this)[row * columns + column]);
  }
  DAUMIER_CHECK(matrix.allFinite(), "{}: an element is not finite", name_);
  return matrix;
}

Eigen::VectorXf NumberArray::Vector(int64_t size) const {
  return Matrix(size < 0 ? size_ : size, 1);
}

geometry::Points NumberArray::Points() const {
  const auto sizes = squeezed();
  DAUMIER_CHECK(size_ > 0 && size_ % 3 == 0 && (sizes.size() == 1 || (sizes.size() == 2 && sizes[1] == 3)),
                "{} has the shape ({}), expected V x 3 or 3V", name_, fmt::join(shape_, ", "));
  geometry::Points points(size_ / 3, 3);
  for (int64_t k = 0; k < size_; ++k) points.data()[k] = (*this)[k];
  DAUMIER_CHECK(points.allFinite(), "{}: a position is not finite", name_);
  return points;
}

geometry::PolygonMesh NumberArray::Polygons(int first, geometry::Points vertices) const {
  DAUMIER_CHECK(shape_.size() == 2 && shape_[0] > 0 && (shape_[1] == 3 || shape_[1] == 4),
                "{} has the shape ({}), expected F x 3 or F x 4", name_, fmt::join(shape_, ", "));
  geometry::PolygonMesh mesh;
  mesh.vertices = std::move(vertices);
  const auto num_vertices = static_cast<int>(mesh.vertices.rows()), size = static_cast<int>(shape_[1]);
  for (int64_t k = 0; k < size_; ++k) {
    const double vertex = (*this)[k] - first;
    DAUMIER_CHECK(vertex >= 0 && vertex < num_vertices && vertex == std::floor(vertex),
                  "{}: polygon {} has the corner {}, expected a whole number in [{}, {})", name_, k / size,
                  vertex + first, first, num_vertices + first);
    mesh.corners.push_back(static_cast<int>(vertex));
    if (k % size == size - 1) mesh.offsets.push_back(static_cast<int>(mesh.corners.size()));
  }
  return mesh;
}

NumberArray NumberArray::Transposed() const {
  return {type_, std::vector<int64_t>(shape_.rbegin(), shape_.rend()),
          order_ == Order::kRowMajor ? Order::kColumnMajor : Order::kRowMajor, bytes_, name_};
}

const NumberArray& ArrayOf(const NumberArrays& arrays, const std::string& name, const std::string& file) {
  const auto found = arrays.find(name);
  if (found != arrays.end()) return found->second;
  std::vector<std::string> names;
  for (const auto& [other, array] : arrays) names.push_back(other);
  throw Error(fmt::format("{} has no array '{}'; it has: {}", file, name, fmt::join(names, ", ")));
}

}  // namespace daumier::faces
