#include "runtime/onnx_tensor.h"

#include "core/error.h"

#include <algorithm>
#include <cstring>

namespace daumier::runtime {
namespace {

/// {key, value} of ONNX's StringStringEntryProto.
std::pair<std::string, std::string> EntryOf(WireReader entry) {
  std::pair<std::string, std::string> pair;
  while (entry.Next()) {
    if (entry.field() == 1) pair.first = std::string(entry.Bytes());
    if (entry.field() == 2) pair.second = std::string(entry.Bytes());
  }
  return pair;
}

struct BrainFloat {
  uint16_t bits;
};
float FloatFromBrain(BrainFloat brain) {
  return std::bit_cast<float>(uint32_t{brain.bits} << 16);
}

/// The numbers of a tensor, which are stored raw as `Stored`, or in a list.
template <class Stored, class Listed, class FromRaw, class FromList>
auto NumbersOfTensor(const StoredTensor& stored, const std::vector<Listed>& list, const FromRaw& from_raw,
                     const FromList& from_list) {
  const auto size = size_t(CheckedSize(stored.shape, fmt::format("the tensor '{}'", stored.name)));
  std::vector<decltype(from_raw(Stored{}))> numbers;
  if (!list.empty() && stored.raw.empty()) {
    DAUMIER_CHECK(list.size() == size, "the tensor '{}' has {} numbers, expected {} for {}", stored.name, list.size(),
                  size, ShapeText(stored.shape));
    std::ranges::transform(list, std::back_inserter(numbers), from_list);
    return numbers;
  }
  DAUMIER_CHECK(stored.raw.size() == size * sizeof(Stored), "the tensor '{}' has {} bytes, expected {} for {}",
                stored.name, stored.raw.size(), size * sizeof(Stored), ShapeText(stored.shape));
  numbers.resize(size);
  for (size_t i = 0; i < size; ++i) {
    Stored number;
    std::memcpy(&number, stored.raw.data() + i * sizeof(Stored), sizeof(Stored));
    numbers[i] = from_raw(number);
  }
  return numbers;
}

template <class Stored>
std::vector<int64_t> IntegersOfTensor(const StoredTensor& stored) {
  return NumbersOfTensor<Stored>(
      stored, stored.integers, [](Stored number) { return static_cast<int64_t>(number); },
      [](int64_t number) { return number; });
}

std::vector<float> RealsOfTensor(const StoredTensor& stored) {
  const auto same = [](auto number) { return static_cast<float>(number); };
  const auto half = [](Half number) { return FloatFromHalf(number); };
  switch (stored.type) {
    case kFloat32:
      return NumbersOfTensor<float>(stored, stored.floats, same, same);
    case kFloat64:
      return NumbersOfTensor<double>(stored, stored.doubles, same, same);
    case kFloat16:
      return NumbersOfTensor<Half>(stored, stored.integers, half,
                                   [](int64_t bits) { return FloatFromHalf(Half{uint16_t(bits)}); });
    default:
      return NumbersOfTensor<BrainFloat>(stored, stored.integers, FloatFromBrain,
                                         [](int64_t bits) { return FloatFromBrain({uint16_t(bits)}); });
  }
}

std::vector<int64_t> WholeNumbersOfTensor(const StoredTensor& stored) {
  switch (stored.type) {
    case kBool:
    case kUint8:
      return IntegersOfTensor<uint8_t>(stored);
    case kInt8:
      return IntegersOfTensor<int8_t>(stored);
    case kUint16:
      return IntegersOfTensor<uint16_t>(stored);
    case kInt16:
      return IntegersOfTensor<int16_t>(stored);
    case kInt32:
      return IntegersOfTensor<int32_t>(stored);
    case kUint32:
      return IntegersOfTensor<uint32_t>(stored);
    case kInt64:
    case kUint64:
      return IntegersOfTensor<int64_t>(stored);
    default:
      throw Error(fmt::format("the tensor '{}' has the element type {}, which is no number that is read", stored.name,
                              stored.type));
  }
}

}  // namespace

bool IsRealType(int64_t type) {
  return type == kFloat32 || type == kFloat16 || type == kFloat64 || type == kBfloat16;
}

StoredTensor StoredTensorOf(WireReader tensor) {
  StoredTensor stored;
  while (tensor.Next()) {
    switch (tensor.field()) {
      case 1:
        tensor.Integers([&](int64_t size) {
          DAUMIER_CHECK(stored.shape.size() < kMostDimensions, "a tensor has more than {} dimensions", kMostDimensions);
          stored.shape.push_back(size);
        });
        break;
      case 2:
        stored.type = tensor.Integer();
        break;
      case 4:
        tensor.Numbers<float>([&](float number) { stored.floats.push_back(number); });
        break;
      case 5:
      case 7:
      case 11:
        tensor.Integers([&](int64_t number) { stored.integers.push_back(number); });
        break;
      case 8:
        stored.name = std::string(tensor.Bytes());
        break;
      case 9:
        stored.raw = tensor.Bytes();
        break;
      case 10:
        tensor.Numbers<double>([&](double number) { stored.doubles.push_back(number); });
        break;
      case 13: {
        const auto [key, value] = EntryOf(tensor.Message());
        if (key == "location") stored.location = value;
        break;
      }
      case 14:
        stored.is_external = tensor.Integer() == 1;
        break;
      case 3:
      case 6:
        throw Error(fmt::format("the tensor '{}' has data in field {}: segments or text", stored.name, tensor.field()));
      default:
        break;
    }
  }
  return stored;
}

GraphTensor TensorReader::Read(const StoredTensor& stored) {
  GraphTensor tensor{.shape = stored.shape};
  if (IsRealType(stored.type)) {
    tensor.numbers = stored.is_external ? External(stored) : RealsOfTensor(stored);
    return tensor;
  }
  DAUMIER_CHECK(!stored.is_external, "the tensor '{}' of integers is external", stored.name);
  tensor.integers = WholeNumbersOfTensor(stored);
  tensor.has_integers = true;
  return tensor;
}

std::vector<float> TensorReader::External(const StoredTensor& stored) {
  const std::filesystem::path location = stored.location;
  DAUMIER_CHECK(!location.empty() && location == location.filename() && location.extension() == ".safetensors",
                "the tensor '{}' lies in '{}' (expected a safetensors file of the same folder, or a model of one file: "
                "onnx.save(model, file, save_as_external_data=False))",
                stored.name, stored.location);
  if (!file_ || location_ != location) {
    file_.emplace(folder_ / location);
    location_ = location;
  }
  const ArrayView& array = file_->at(stored.name);
  DAUMIER_CHECK(array.shape == stored.shape, "the tensor '{}' is {} in {} (expected {})", stored.name,
                ShapeText(array.shape), stored.location, ShapeText(stored.shape));
  std::vector<float> numbers;
  if (array.dtype == Dtype::kF16) {
    numbers.resize(size_t(array.size()));
    std::ranges::transform(array.As<Half>(), numbers.begin(), FloatFromHalf);
  } else {
    const std::span<const float> floats = array.As<float>();
    numbers.assign(floats.begin(), floats.end());
  }
  return numbers;
}

}  // namespace daumier::runtime
