#include "faces/import/hdf5_file.h"

#include "core/error.h"

#include <hdf5.h>

#include <utility>

namespace daumier::faces {

namespace {

/// An identifier of the HDF5 library, closed by the function that belongs to its kind.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// The library prints its error stack; our exceptions report the fault instead.
class SilentHdf5 {
 public:
  SilentHdf5() {
    H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~SilentHdf5() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

struct NativeType {
  NumberArray::Type type;
  hid_t memory;  ///< What the library converts to, whatever the byte order of the file.
};

NativeType TypeOf(hid_t stored, const std::string& name) {
  using Type = NumberArray::Type;
  const H5T_class_t kind = H5Tget_class(stored);
  const size_t size = H5Tget_size(stored);
  DAUMIER_CHECK((kind == H5T_FLOAT || kind == H5T_INTEGER) && size <= 8, "{} holds no usual numbers", name);
  if (kind == H5T_FLOAT && size <= 4) return {Type::kF32, H5T_NATIVE_FLOAT};
  if (kind == H5T_FLOAT) return {Type::kF64, H5T_NATIVE_DOUBLE};
  if (H5Tget_sign(stored) == H5T_SGN_NONE) return {Type::kU64, H5T_NATIVE_UINT64};
  return {Type::kI64, H5T_NATIVE_INT64};
}

/// Whether every group on the way to a data set exists; H5Lexists checks the last step only.
bool HasPath(hid_t file, const std::string& path) {
  for (size_t end = path.find('/'); end != std::string::npos; end = path.find('/', end + 1)) {
    if (H5Lexists(file, path.substr(0, end).c_str(), H5P_DEFAULT) <= 0) return false;
  }
  return H5Lexists(file, path.c_str(), H5P_DEFAULT) > 0;
}

NumberArray ReadDataSet(hid_t file, const std::string& path, const std::string& name) {
  const Handle data(H5Dopen2(file, path.c_str(), H5P_DEFAULT), H5Dclose);
  DAUMIER_CHECK(data >= 0, "{} is no data set, or damaged", name);
  const Handle stored(H5Dget_type(data), H5Tclose), space(H5Dget_space(data), H5Sclose);
  const int rank = H5Sget_simple_extent_ndims(space);
  DAUMIER_CHECK(stored >= 0 && rank >= 0, "{} is damaged", name);
  std::vector<hsize_t> sizes(rank);
  H5Sget_simple_extent_dims(space, sizes.data(), nullptr);
  const std::vector<int64_t> shape(sizes.begin(), sizes.end());
  const NativeType type = TypeOf(stored, name);
  const size_t num_bytes = NumberArray::NumBytes(type.type, shape, name);
  // A header may claim any size; what lies in the file, packed by at most 1 : 1032, bounds it.
  constexpr size_t kMostInflated = 1100;
  hsize_t file_size = 0;
  DAUMIER_CHECK(H5Fget_filesize(file, &file_size) >= 0 && num_bytes / kMostInflated <= file_size * 8,
                "{} claims {} bytes in a file of {}", name, num_bytes, file_size);
  std::string bytes(num_bytes, '\0');
  DAUMIER_CHECK(H5Dread(data, type.memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data()) >= 0,
                "{} cannot be read: the file is truncated or damaged", name);
  return {type.type, shape, NumberArray::Order::kRowMajor, std::move(bytes), name};
}

/// The caller closes it.
hid_t OpenFile(const std::filesystem::path& path) {
  DAUMIER_CHECK(std::filesystem::exists(path), "{} does not exist", path.string());
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  DAUMIER_CHECK(file >= 0, "{} cannot be opened as an HDF5 file: it is another format, truncated or damaged",
                path.string());
  return file;
}

/// Adds the name of a link to the set behind `names`.
herr_t AddName(hid_t, const char* name, const H5L_info_t*, void* names) {
  static_cast<std::set<std::string>*>(names)->insert(name);
  return 0;
}

}  // namespace

NumberArrays ReadHdf5(const std::filesystem::path& path, const std::set<std::string>& wanted) {
  const SilentHdf5 silent;
  const Handle file(OpenFile(path), H5Fclose);
  NumberArrays arrays;
  for (const std::string& name : wanted) {
    if (HasPath(file, name)) arrays[name] = ReadDataSet(file, name, fmt::format("{}: {}", path.string(), name));
  }
  return arrays;
}

std::set<std::string> Hdf5Names(const std::filesystem::path& path) {
  const SilentHdf5 silent;
  const Handle file(OpenFile(path), H5Fclose);
  std::set<std::string> names;
  DAUMIER_CHECK(H5Literate(file, H5_INDEX_NAME, H5_ITER_NATIVE, nullptr, AddName, &names) >= 0, "{} is damaged",
                path.string());
  return names;
}

}  // namespace daumier::faces
