#include "tensor/tensor_file.h"

namespace daumier::tensor {
namespace {

struct TypePair {
  Dtype stored;
  torch::ScalarType type;
};
constexpr TypePair kTypes[] = {{Dtype::kU8, torch::kUInt8},    {Dtype::kI32, torch::kInt32},
                               {Dtype::kI64, torch::kInt64},   {Dtype::kF32, torch::kFloat32},
                               {Dtype::kF64, torch::kFloat64}, {Dtype::kF16, torch::kFloat16},
                               {Dtype::kI8, torch::kInt8},     {Dtype::kI16, torch::kInt16}};

torch::ScalarType TypeOf(Dtype stored) {
  for (const auto& pair : kTypes) {
    if (pair.stored == stored) return pair.type;
  }
  throw Error("array has an element type that no tensor has");
}

Dtype StoredTypeOf(const torch::Tensor& tensor, const std::string& name) {
  for (const auto& pair : kTypes) {
    if (pair.type == tensor.scalar_type()) return pair.stored;
  }
  throw Error(fmt::format("tensor '{}' has element type {}, which cannot be stored; convert it to float32 or int64",
                          name, c10::toString(tensor.scalar_type())));
}

}  // namespace

torch::Tensor ViewOfArray(const SafetensorsFile& file, const std::string& name) {
  const ArrayView& array = file.at(name);
  return torch::from_blob(
      const_cast<void*>(array.data), array.shape, [file](void*) {}, TypeOf(array.dtype));
}

std::string SaveTensors(const std::filesystem::path& file, const NamedTensors& tensors) {
  SafetensorsWriter writer;
  for (const auto& [name, tensor] : tensors) {
    const Dtype stored = StoredTypeOf(tensor, name);
    const auto plain = tensor.detach().cpu().contiguous();
    writer.AddBytes(name, stored, plain.sizes().vec(), plain.data_ptr(), plain.nbytes());
  }
  return writer.Write(file);
}

NamedTensors LoadTensors(const std::filesystem::path& file) {
  const SafetensorsFile mapped(file);
  NamedTensors tensors;
  for (const auto& [name, array] : mapped.arrays()) tensors[name] = ViewOfArray(mapped, name).clone();
  return tensors;
}

}  // namespace daumier::tensor
