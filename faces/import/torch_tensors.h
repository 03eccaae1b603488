#pragma once
#include "core/array.h"
#include "faces/import/pickle.h"

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace daumier::faces {

/// Functions and classes that a state of a network names, for ReadPickle.
const std::set<std::string>& TorchNames();

/// A tensor of a pickle: a view of a storage, which lies elsewhere.
struct StoredTensor {
  enum class Type { kF16, kBF16, kF32, kF64, kU8, kI8, kI16, kI32, kI64 };
  Type type = Type::kF32;
  std::string storage;                            ///< Its key.
  int64_t storage_size = 0;                       ///< Elements.
  int64_t offset = 0;                             ///< Of the first element.
  std::vector<int64_t> shape = {}, strides = {};  ///< In elements; the view lies inside of the storage.

  int64_t size() const;
  int64_t storage_bytes() const;
};

/// The tensors of the state in a pickle, by name (faces/import/torch_file.h). `name` names it in messages.
/// @throws Error naming the tensor and what is wrong with it, or the dictionaries among which none is chosen.
std::map<std::string, StoredTensor> TensorsOf(const Pickle& pickle, const std::string& name);

/// Bytes of each storage that a pickle refers to, by key, of whatever tensor. @throws Error as TensorsOf.
std::map<std::string, int64_t> StorageBytes(const Pickle& pickle, const std::string& name);

/// The elements of a tensor, row-major, as float32. storage: tensor.storage_bytes() bytes.
FloatArray Elements(const StoredTensor& tensor, std::string_view storage);

}  // namespace daumier::faces
