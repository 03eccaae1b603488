#pragma once
#include "core/error.h"
#include "core/files.h"

#include <archive.h>
#include <archive_entry.h>
#include <hdf5.h>
#include <zlib.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

/// Writes the file formats of other people's face models, byte for byte as they lie on disk.
namespace daumier::testing {

template <class T>
std::string BytesOf(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), sizeof(T) * values.size()};
}

template <class T>
std::string BytesOf(T value) {
  return BytesOf(std::vector<T>{value});
}

/// A .npy file of version 1 (or 2, whose header length has four bytes).
inline std::string Npy(const std::string& descr, const std::string& shape, const std::string& data,
                       bool is_fortran = false, char version = 1) {
  std::string header = fmt::format("{{'descr': '{}', 'fortran_order': {}, 'shape': ({}), }}", descr,
                                   is_fortran ? "True" : "False", shape);
  const size_t begin = version == 1 ? 10 : 12;
  header.append(64 - (begin + header.size() + 1) % 64, ' ');
  header += '\n';
  std::string bytes = "\x93NUMPY";
  bytes += version;
  bytes += '\0';
  bytes += version == 1 ? BytesOf(static_cast<uint16_t>(header.size())) : BytesOf(static_cast<uint32_t>(header.size()));
  return bytes + header + data;
}

/// A zip archive of NAME.npy files.
inline void WriteNpz(const std::filesystem::path& path, const std::map<std::string, std::string>& arrays) {
  archive* const writer = archive_write_new();
  archive_write_set_format_zip(writer);
  DAUMIER_CHECK(archive_write_open_filename(writer, path.c_str()) == ARCHIVE_OK, "cannot write {}", path.string());
  for (const auto& [name, bytes] : arrays) {
    archive_entry* const entry = archive_entry_new();
    archive_entry_set_pathname(entry, (name + ".npy").c_str());
    archive_entry_set_filetype(entry, AE_IFREG);
    archive_entry_set_perm(entry, 0644);
    archive_entry_set_size(entry, static_cast<int64_t>(bytes.size()));
    archive_write_header(writer, entry);
    archive_write_data(writer, bytes.data(), bytes.size());
    archive_entry_free(entry);
  }
  archive_write_close(writer);
  archive_write_free(writer);
}

/// A data element of a MATLAB 5 file: type, size, data, padding; up to four bytes in the small form.
inline std::string MatElement(uint32_t type, const std::string& data) {
  std::string bytes;
  if (data.size() <= 4 && !data.empty()) {
    bytes = BytesOf(static_cast<uint32_t>(data.size() << 16 | type)) + data;
  } else {
    bytes = BytesOf(type) + BytesOf(static_cast<uint32_t>(data.size())) + data;
  }
  return bytes.append((8 - bytes.size() % 8) % 8, '\0');
}

/// A numeric variable; `data` column by column, `type` its element type, `kind` the class of the array and its flags.
inline std::string MatVariable(const std::string& name, const std::vector<int32_t>& shape, uint32_t type,
                               const std::string& data, uint32_t kind = 6) {
  return MatElement(14, MatElement(6, BytesOf(std::vector<uint32_t>{kind, 0})) + MatElement(5, BytesOf(shape)) +
                            MatElement(1, name) + MatElement(type, data));
}

inline std::string MatCompressed(const std::string& variable) {
  uLongf size = compressBound(variable.size());
  std::string packed(size, '\0');
  compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(variable.data()),
           variable.size());
  packed.resize(size);
  return BytesOf(uint32_t{15}) + BytesOf(static_cast<uint32_t>(size)) + packed;
}

inline std::string MatFile(const std::string& variables) {
  std::string header = "MATLAB 5.0 MAT-file, Platform: GLNXA64, Created on: Mon Jan 01 00:00:00 2009";
  header.resize(124, ' ');
  return header + BytesOf(uint16_t{0x0100}) + "IM" + variables;
}

/// Writes data sets, making the groups on their way.
class Hdf5Writer {
 public:
  explicit Hdf5Writer(const std::filesystem::path& path)
      : file_(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT)) {}
  ~Hdf5Writer() { H5Fclose(file_); }
  Hdf5Writer(const Hdf5Writer&) = delete;
  Hdf5Writer& operator=(const Hdf5Writer&) = delete;

  void Add(const std::string& path, const std::vector<hsize_t>& shape, const std::vector<float>& values) {
    Add(path, shape, H5T_IEEE_F32LE, H5T_NATIVE_FLOAT, values.data());
  }
  void Add(const std::string& path, const std::vector<hsize_t>& shape, const std::vector<int>& values) {
    Add(path, shape, H5T_STD_I32LE, H5T_NATIVE_INT, values.data());
  }
  void Add(const std::string& path, const std::vector<hsize_t>& shape, hid_t stored, hid_t memory, const void* values) {
    const hid_t links = H5Pcreate(H5P_LINK_CREATE);
    H5Pset_create_intermediate_group(links, 1);
    const hid_t space = H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr);
    const hid_t data = H5Dcreate2(file_, path.c_str(), stored, space, links, H5P_DEFAULT, H5P_DEFAULT);
    H5Dwrite(data, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, values);
    H5Dclose(data);
    H5Sclose(space);
    H5Pclose(links);
  }

 private:
  hid_t file_;
};

}  // namespace daumier::testing
