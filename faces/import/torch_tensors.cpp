#include "faces/import/torch_tensors.h"

#include "core/error.h"
#include "core/half.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <optional>
#include <utility>

namespace daumier::faces {
namespace {

using PickleKind = Pickle::Kind;
using ElementType = StoredTensor::Type;

const std::map<std::string, ElementType>& StorageTypes() {
  static const std::map<std::string, ElementType> types = {
      {"torch.HalfStorage", ElementType::kF16},  {"torch.BFloat16Storage", ElementType::kBF16},
      {"torch.FloatStorage", ElementType::kF32}, {"torch.DoubleStorage", ElementType::kF64},
      {"torch.ByteStorage", ElementType::kU8},   {"torch.BoolStorage", ElementType::kU8},
      {"torch.CharStorage", ElementType::kI8},   {"torch.ShortStorage", ElementType::kI16},
      {"torch.IntStorage", ElementType::kI32},   {"torch.LongStorage", ElementType::kI64}};
  return types;
}

int64_t ItemBytes(ElementType type) {
  switch (type) {
    case ElementType::kU8:
    case ElementType::kI8:
      return 1;
    case ElementType::kF16:
    case ElementType::kBF16:
    case ElementType::kI16:
      return 2;
    case ElementType::kF32:
    case ElementType::kI32:
      return 4;
    case ElementType::kF64:
    case ElementType::kI64:
      return 8;
  }
  return 0;
}

/// The product of sizes; nothing if one is negative or the product needs more than 63 bits.
std::optional<int64_t> ProductOf(const std::vector<int64_t>& sizes) {
  if (std::ranges::any_of(sizes, [](int64_t size) { return size < 0; })) return std::nullopt;
  if (std::ranges::count(sizes, 0) > 0) return 0;
  int64_t product = 1;
  for (const int64_t size : sizes)
    if (__builtin_mul_overflow(product, size, &product)) return std::nullopt;
  return product;
}

/// Tensors among the values of a pickle.
class TensorFinder {
 public:
  TensorFinder(const Pickle& pickle, const std::string& name) : pickle_(pickle), name_(name) {}

  std::map<std::string, StoredTensor> State() const {
    const int dictionary = StateDictionary();
    std::map<std::string, StoredTensor> tensors;
    ForEachItem(dictionary, [&](const std::string& key, int value) {
      if (const auto call = TensorCall(value)) tensors[key] = TensorOf(key, *call);
    });
    const auto is_parallel = [](const auto& item) { return item.first.starts_with(kParallel); };
    if (!std::ranges::all_of(tensors, is_parallel)) return tensors;
    std::map<std::string, StoredTensor> renamed;
    for (auto& [key, tensor] : tensors) renamed[key.substr(kParallel.size())] = std::move(tensor);
    return renamed;
  }

  std::map<std::string, int64_t> StorageBytes() const {
    std::map<std::string, int64_t> bytes;
    for (const Pickle::Value& value : pickle_.values) {
      if (value.kind != PickleKind::kReference) continue;
      const StoredTensor storage = StorageOf(value, "a tensor");
      bytes[storage.storage] = storage.storage_bytes();
    }
    return bytes;
  }

 private:
  static constexpr std::string_view kParallel = "module.";

  const Pickle::Value& At(int place) const { return pickle_[place]; }

  /// A value behind the marks that LibTorch puts around containers.
  int Unwrapped(int place) const {
    constexpr int kMostMarks = 4;
    for (int i = 0; i < kMostMarks; ++i) {
      const Pickle::Value& value = At(place);
      const bool is_mark = value.kind == PickleKind::kCall && (value.text == "torch.jit._pickle.restore_type_tag" ||
                                                               value.text == "torch._utils._rebuild_parameter");
      if (!is_mark || At(value.items[0]).items.empty()) break;
      place = At(value.items[0]).items[0];
    }
    return place;
  }

  template <class Use>
  void ForEachItem(int dictionary, Use use) const {
    const std::vector<int>& items = At(dictionary).items;
    for (size_t i = 0; i + 1 < items.size(); i += 2)
      if (At(items[i]).kind == PickleKind::kText) use(At(items[i]).text, items[i + 1]);
  }

  /// Arguments of the call that makes a tensor, if the value is one.
  std::optional<std::vector<int>> TensorCall(int place) const {
    const Pickle::Value& value = At(Unwrapped(place));
    if (value.kind != PickleKind::kCall ||
        (value.text != "torch._utils._rebuild_tensor_v2" && value.text != "torch._utils._rebuild_tensor"))
      return std::nullopt;
    return At(value.items[0]).items;
  }

  bool HasTensors(int place) const {
    bool found = false;
    if (At(place).kind == PickleKind::kDictionary)
      ForEachItem(place, [&](const std::string&, int value) { found |= TensorCall(value).has_value(); });
    return found;
  }

  int StateDictionary() const {
    const int root = Unwrapped(pickle_.root);
    if (HasTensors(root)) return root;
    std::map<std::string, int> found;
    std::map<int, bool> scanned;  // A file may name one dictionary many times.
    if (At(root).kind == PickleKind::kDictionary) {
      ForEachItem(root, [&](const std::string& key, int value) {
        const int place = Unwrapped(value);
        if (!scanned.contains(place)) scanned[place] = HasTensors(place);
        if (scanned[place]) found[key] = place;
      });
    }
    DAUMIER_CHECK(!found.empty(), "{}: there are no tensors by name; expected the state of a network", name_);
    if (found.size() == 1) return found.begin()->second;
    for (const char* usual : {"model", "state_dict", "model_state_dict", "network", "net"})
      if (found.contains(usual)) return found[usual];
    std::vector<std::string> names;
    for (const auto& item : found) names.push_back(item.first);
    throw Error(fmt::format("{}: there are several dictionaries of tensors: {}", name_, fmt::join(names, ", ")));
  }

  int64_t IntegerAt(int place, const std::string& tensor) const {
    DAUMIER_CHECK(At(place).kind == PickleKind::kInteger, "{}: a size of '{}' is no whole number", name_, tensor);
    return At(place).integer;
  }

  std::vector<int64_t> IntegersAt(int place, const std::string& tensor) const {
    constexpr size_t kMostDimensions = 64;
    const Pickle::Value& tuple = At(place);
    DAUMIER_CHECK(tuple.kind == PickleKind::kTuple && tuple.items.size() <= kMostDimensions, "{}: '{}' has no sizes",
                  name_, tensor);
    std::vector<int64_t> integers;
    for (const int item : tuple.items) integers.push_back(IntegerAt(item, tensor));
    return integers;
  }

  StoredTensor TensorOf(const std::string& tensor, const std::vector<int>& arguments) const {
    DAUMIER_CHECK(arguments.size() >= 4 && At(arguments[0]).kind == PickleKind::kReference, "{}: '{}' has no storage",
                  name_, tensor);
    StoredTensor found = StorageOf(At(arguments[0]), tensor);
    found.offset = IntegerAt(arguments[1], tensor);
    found.shape = IntegersAt(arguments[2], tensor);
    found.strides = IntegersAt(arguments[3], tensor);
    CheckInside(found, tensor);
    return found;
  }

  /// Of a reference ("storage", type, key, device, elements), and in the older format a view of it or None.
  StoredTensor StorageOf(const Pickle::Value& reference, const std::string& tensor) const {
    const std::vector<int>& storage = At(reference.items[0]).items;
    DAUMIER_CHECK(storage.size() >= 5 && At(storage[0]).text == "storage" && At(storage[2]).kind == PickleKind::kText,
                  "{}: '{}' has no storage", name_, tensor);
    DAUMIER_CHECK(storage.size() < 6 || At(storage[5]).kind == PickleKind::kNone,
                  "{}: '{}' is a view of a storage of PyTorch before 0.4", name_, tensor);
    const auto type = StorageTypes().find(At(storage[1]).text);
    DAUMIER_CHECK(At(storage[1]).kind == PickleKind::kName && type != StorageTypes().end(),
                  "{}: the elements of '{}' are no real numbers", name_, tensor);
    constexpr int64_t kMostElements = int64_t{1} << 48;
    StoredTensor found{type->second, At(storage[2]).text, IntegerAt(storage[4], tensor)};
    DAUMIER_CHECK(found.storage_size >= 0 && found.storage_size <= kMostElements,
                  "{}: the storage of '{}' has {} elements", name_, tensor, found.storage_size);
    return found;
  }

  void CheckInside(const StoredTensor& found, const std::string& tensor) const {
    const std::optional<int64_t> size = ProductOf(found.shape);
    bool is_inside = size && found.shape.size() == found.strides.size() && found.offset >= 0;
    int64_t last = found.offset;
    for (size_t k = 0; is_inside && *size > 0 && k < found.shape.size(); ++k) {
      int64_t step = 0;
      is_inside = found.strides[k] >= 0 && !__builtin_mul_overflow(found.shape[k] - 1, found.strides[k], &step) &&
                  !__builtin_add_overflow(last, step, &last);
    }
    DAUMIER_CHECK(is_inside && (*size == 0 || last < found.storage_size),
                  "{}: the tensor '{}' of shape ({}) lies outside of its storage of {} elements", name_, tensor,
                  fmt::join(found.shape, ", "), found.storage_size);
  }

  const Pickle& pickle_;
  const std::string& name_;
};

template <class T, class Convert>
void Gather(const StoredTensor& tensor, std::string_view storage, std::vector<float>& values, Convert convert) {
  const size_t num_dimensions = tensor.shape.size();
  std::vector<int64_t> index(num_dimensions, 0);
  int64_t place = tensor.offset;
  for (float& value : values) {
    T element;
    std::memcpy(&element, storage.data() + place * int64_t(sizeof(T)), sizeof(T));
    value = convert(element);
    for (size_t k = num_dimensions; k-- > 0;) {  // The next one in row-major order.
      place += tensor.strides[k];
      if (++index[k] < tensor.shape[k]) break;
      place -= index[k] * tensor.strides[k];
      index[k] = 0;
    }
  }
}

template <class T>
float AsFloat(T element) {
  return static_cast<float>(element);
}

}  // namespace

const std::set<std::string>& TorchNames() {
  static const std::set<std::string> names = [] {
    std::set<std::string> all = {"collections.OrderedDict", "torch._utils._rebuild_tensor",
                                 "torch._utils._rebuild_tensor_v2", "torch._utils._rebuild_parameter",
                                 "torch.jit._pickle.restore_type_tag"};
    for (const auto& item : StorageTypes()) all.insert(item.first);
    return all;
  }();
  return names;
}

int64_t StoredTensor::size() const {
  return *ProductOf(shape);
}

int64_t StoredTensor::storage_bytes() const {
  return storage_size * ItemBytes(type);
}

std::map<std::string, StoredTensor> TensorsOf(const Pickle& pickle, const std::string& name) {
  return TensorFinder(pickle, name).State();
}

std::map<std::string, int64_t> StorageBytes(const Pickle& pickle, const std::string& name) {
  return TensorFinder(pickle, name).StorageBytes();
}

FloatArray Elements(const StoredTensor& tensor, std::string_view storage) {
  DAUMIER_CHECK(std::ssize(storage) == tensor.storage_bytes(), "a storage of {} bytes, expected {}", storage.size(),
                tensor.storage_bytes());
  FloatArray array(tensor.shape);
  switch (tensor.type) {
    case ElementType::kF16:
      Gather<Half>(tensor, storage, array.values, FloatFromHalf);
      break;
    case ElementType::kBF16:
      Gather<uint16_t>(tensor, storage, array.values,
                       [](uint16_t bits) { return std::bit_cast<float>(uint32_t{bits} << 16); });
      break;
    case ElementType::kF32:
      Gather<float>(tensor, storage, array.values, AsFloat<float>);
      break;
    case ElementType::kF64:
      Gather<double>(tensor, storage, array.values, AsFloat<double>);
      break;
    case ElementType::kU8:
      Gather<uint8_t>(tensor, storage, array.values, AsFloat<uint8_t>);
      break;
    case ElementType::kI8:
      Gather<int8_t>(tensor, storage, array.values, AsFloat<int8_t>);
      break;
    case ElementType::kI16:
      Gather<int16_t>(tensor, storage, array.values, AsFloat<int16_t>);
      break;
    case ElementType::kI32:
      Gather<int32_t>(tensor, storage, array.values, AsFloat<int32_t>);
      break;
    case ElementType::kI64:
      Gather<int64_t>(tensor, storage, array.values, AsFloat<int64_t>);
      break;
  }
  return array;
}

}  // namespace daumier::faces
