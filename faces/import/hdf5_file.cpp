#include "faces/import/hdf5_file.h"

#include "core/error.h"
#include "core/late_library.h"

#include <hdf5.h>

#include <utility>

namespace daumier::faces {

namespace {

constexpr unsigned int kReadOnly = 0;  // H5F_ACC_RDONLY, whose macro calls the library.

/// The functions and types of the HDF5 library that are used here.
struct Hdf5 {
  LateLibrary library{DAUMIER_HDF5, "reads HDF5 files"};
  decltype(H5open)* open = library["H5open"];
  decltype(H5Eget_auto2)* get_error_function = library["H5Eget_auto2"];
  decltype(H5Eset_auto2)* set_error_function = library["H5Eset_auto2"];
  decltype(H5Fopen)* open_file = library["H5Fopen"];
  decltype(H5Fclose)* close_file = library["H5Fclose"];
  decltype(H5Fget_filesize)* file_size = library["H5Fget_filesize"];
  decltype(H5Gget_info)* group_info = library["H5Gget_info"];
  decltype(H5Lexists)* link_exists = library["H5Lexists"];
  decltype(H5Lget_name_by_idx)* link_name = library["H5Lget_name_by_idx"];
  decltype(H5Dopen2)* open_data = library["H5Dopen2"];
  decltype(H5Dclose)* close_data = library["H5Dclose"];
  decltype(H5Dread)* read_data = library["H5Dread"];
  decltype(H5Dget_type)* type_of_data = library["H5Dget_type"];
  decltype(H5Dget_space)* space_of_data = library["H5Dget_space"];
  decltype(H5Sclose)* close_space = library["H5Sclose"];
  decltype(H5Sget_simple_extent_ndims)* rank = library["H5Sget_simple_extent_ndims"];
  decltype(H5Sget_simple_extent_dims)* sizes = library["H5Sget_simple_extent_dims"];
  decltype(H5Tclose)* close_type = library["H5Tclose"];
  decltype(H5Tget_class)* class_of_type = library["H5Tget_class"];
  decltype(H5Tget_size)* size_of_type = library["H5Tget_size"];
  decltype(H5Tget_sign)* sign_of_type = library["H5Tget_sign"];

  // The library gives its types their numbers when it opens.
  herr_t opened = open();
  hid_t f32 = *static_cast<hid_t*>(library["H5T_NATIVE_FLOAT_g"]);
  hid_t f64 = *static_cast<hid_t*>(library["H5T_NATIVE_DOUBLE_g"]);
  hid_t u64 = *static_cast<hid_t*>(library["H5T_NATIVE_UINT64_g"]);
  hid_t i64 = *static_cast<hid_t*>(library["H5T_NATIVE_INT64_g"]);
};

const Hdf5& LoadedHdf5() {
  static const Hdf5 functions;
  return functions;
}

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
    LoadedHdf5().get_error_function(H5E_DEFAULT, &function_, &data_);
    LoadedHdf5().set_error_function(H5E_DEFAULT, nullptr, nullptr);
  }
  ~SilentHdf5() { LoadedHdf5().set_error_function(H5E_DEFAULT, function_, data_); }

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
  const Hdf5& hdf5 = LoadedHdf5();
  const H5T_class_t kind = hdf5.class_of_type(stored);
  const size_t size = hdf5.size_of_type(stored);
  DAUMIER_CHECK((kind == H5T_FLOAT || kind == H5T_INTEGER) && size <= 8, "{} holds no usual numbers", name);
  if (kind == H5T_FLOAT && size <= 4) return {Type::kF32, hdf5.f32};
  if (kind == H5T_FLOAT) return {Type::kF64, hdf5.f64};
  if (hdf5.sign_of_type(stored) == H5T_SGN_NONE) return {Type::kU64, hdf5.u64};
  return {Type::kI64, hdf5.i64};
}

/// Whether every group on the way to a data set exists; H5Lexists checks the last step only.
bool HasPath(hid_t file, const std::string& path) {
  for (size_t end = path.find('/'); end != std::string::npos; end = path.find('/', end + 1)) {
    if (LoadedHdf5().link_exists(file, path.substr(0, end).c_str(), H5P_DEFAULT) <= 0) return false;
  }
  return LoadedHdf5().link_exists(file, path.c_str(), H5P_DEFAULT) > 0;
}

NumberArray ReadDataSet(hid_t file, const std::string& path, const std::string& name) {
  const Hdf5& hdf5 = LoadedHdf5();
  const Handle data(hdf5.open_data(file, path.c_str(), H5P_DEFAULT), hdf5.close_data);
  DAUMIER_CHECK(data >= 0, "{} is no data set, or damaged", name);
  const Handle stored(hdf5.type_of_data(data), hdf5.close_type), space(hdf5.space_of_data(data), hdf5.close_space);
  const int rank = hdf5.rank(space);
  DAUMIER_CHECK(stored >= 0 && rank >= 0, "{} is damaged", name);
  std::vector<hsize_t> sizes(rank);
  hdf5.sizes(space, sizes.data(), nullptr);
  const std::vector<int64_t> shape(sizes.begin(), sizes.end());
  const NativeType type = TypeOf(stored, name);
  const size_t num_bytes = NumberArray::NumBytes(type.type, shape, name);
  // A header may claim any size; what lies in the file, packed by at most 1 : 1032, bounds it.
  constexpr size_t kMostInflated = 1100;
  hsize_t file_size = 0;
  DAUMIER_CHECK(hdf5.file_size(file, &file_size) >= 0 && num_bytes / kMostInflated <= file_size * 8,
                "{} claims {} bytes in a file of {}", name, num_bytes, file_size);
  std::string bytes(num_bytes, '\0');
  DAUMIER_CHECK(hdf5.read_data(data, type.memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data()) >= 0,
                "{} cannot be read: the file is truncated or damaged", name);
  return {type.type, shape, NumberArray::Order::kRowMajor, std::move(bytes), name};
}

/// The caller closes it.
hid_t OpenFile(const std::filesystem::path& path) {
  DAUMIER_CHECK(std::filesystem::exists(path), "{} does not exist", path.string());
  const hid_t file = LoadedHdf5().open_file(path.c_str(), kReadOnly, H5P_DEFAULT);
  DAUMIER_CHECK(file >= 0, "{} cannot be opened as an HDF5 file: it is another format, truncated or damaged",
                path.string());
  return file;
}

/// The name of the link of this index in the root group.
std::string LinkName(hid_t file, hsize_t index) {
  const auto read = [&](char* name, size_t size) {
    return LoadedHdf5().link_name(file, "/", H5_INDEX_NAME, H5_ITER_NATIVE, index, name, size, H5P_DEFAULT);
  };
  const ssize_t length = read(nullptr, 0);
  if (length < 0) return {};
  std::string name(static_cast<size_t>(length) + 1, '\0');
  if (read(name.data(), name.size()) < 0) return {};
  name.pop_back();
  return name;
}

}  // namespace

NumberArrays ReadHdf5(const std::filesystem::path& path, const std::set<std::string>& wanted) {
  const SilentHdf5 silent;
  const Handle file(OpenFile(path), LoadedHdf5().close_file);
  NumberArrays arrays;
  for (const std::string& name : wanted) {
    if (HasPath(file, name)) arrays[name] = ReadDataSet(file, name, fmt::format("{}: {}", path.string(), name));
  }
  return arrays;
}

std::set<std::string> Hdf5Names(const std::filesystem::path& path) {
  const SilentHdf5 silent;
  const Handle file(OpenFile(path), LoadedHdf5().close_file);
  H5G_info_t group = {};
  DAUMIER_CHECK(LoadedHdf5().group_info(file, &group) >= 0, "{} is damaged", path.string());
  std::set<std::string> names;
  for (hsize_t i = 0; i < group.nlinks; ++i) {
    std::string name = LinkName(file, i);
    DAUMIER_CHECK(!name.empty(), "{} is damaged", path.string());
    names.insert(std::move(name));
  }
  return names;
}

}  // namespace daumier::faces
