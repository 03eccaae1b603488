#pragma once
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

/// Protocol Buffers' wire format, written by hand: what runtime/onnx_file.h reads.
namespace daumier::runtime {

inline std::string Varint(uint64_t value) {
  std::string bytes;
  for (; value >= 0x80; value >>= 7) bytes += char(value | 0x80);
  return bytes + char(value);
}
inline std::string IntegerField(int field, int64_t value) {
  return Varint(uint64_t(field) << 3) + Varint(uint64_t(value));
}
inline std::string BytesField(int field, std::string_view bytes) {
  return Varint(uint64_t(field) << 3 | 2) + Varint(bytes.size()) + std::string(bytes);
}

/// The fields of TensorProto, of float32.
inline std::string OnnxTensor(const std::string& name, const std::vector<int64_t>& shape,
                              const std::vector<float>& numbers) {
  std::string bytes;
  for (const int64_t size : shape) bytes += IntegerField(1, size);
  bytes += IntegerField(2, 1) + BytesField(8, name);
  return bytes + BytesField(9, {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(float)});
}

/// A tensor of another element type, its numbers as raw bytes.
template <class T>
std::string RawTensor(const std::string& name, const std::vector<int64_t>& shape, int64_t type,
                      const std::vector<T>& numbers) {
  std::string bytes;
  for (const int64_t size : shape) bytes += IntegerField(1, size);
  bytes += IntegerField(2, type) + BytesField(8, name);
  return bytes + BytesField(9, {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(T)});
}
inline std::string IntegersTensor(const std::string& name, const std::vector<int64_t>& numbers) {
  return RawTensor(name, {int64_t(numbers.size())}, 7, numbers);
}

/// A tensor whose numbers lie in another file.
inline std::string ExternalTensor(const std::string& name, const std::vector<int64_t>& shape,
                                  const std::string& location) {
  std::string bytes;
  for (const int64_t size : shape) bytes += IntegerField(1, size);
  bytes += IntegerField(2, 1) + BytesField(8, name);
  return bytes + BytesField(13, BytesField(1, "location") + BytesField(2, location)) + IntegerField(14, 1);
}

inline std::string OnnxNode(const std::string& op, const std::vector<std::string>& inputs, const std::string& output,
                            const std::string& attributes = "") {
  std::string bytes;
  for (const std::string& input : inputs) bytes += BytesField(1, input);
  return bytes + BytesField(2, output) + BytesField(3, op + "_0") + BytesField(4, op) + attributes;
}

/// An attribute of integers, as a field of a node.
inline std::string IntegersAttribute(const std::string& name, const std::vector<int64_t>& values) {
  std::string bytes = BytesField(1, name);
  for (const int64_t value : values) bytes += IntegerField(8, value);
  return BytesField(5, bytes + IntegerField(20, 7));
}

inline std::string IntegerAttribute(const std::string& name, int64_t value) {
  return BytesField(5, BytesField(1, name) + IntegerField(3, value) + IntegerField(20, 2));
}
inline std::string RealAttribute(const std::string& name, float value) {
  const std::string number(reinterpret_cast<const char*>(&value), sizeof(value));
  return BytesField(5, BytesField(1, name) + Varint(2 << 3 | 5) + number + IntegerField(20, 1));
}
inline std::string TextAttribute(const std::string& name, const std::string& value) {
  return BytesField(5, BytesField(1, name) + BytesField(4, value) + IntegerField(20, 3));
}
/// tensor: the fields of TensorProto.
inline std::string TensorAttribute(const std::string& name, const std::string& tensor) {
  return BytesField(5, BytesField(1, name) + BytesField(5, tensor) + IntegerField(20, 4));
}

/// ValueInfoProto of float32; -1: the free size "N".
inline std::string OnnxValue(const std::string& name, const std::vector<int64_t>& shape, int64_t type = 1) {
  std::string dimensions;
  for (const int64_t size : shape) dimensions += BytesField(1, size == -1 ? BytesField(2, "N") : IntegerField(1, size));
  return BytesField(1, name) + BytesField(2, BytesField(1, IntegerField(1, type) + BytesField(2, dimensions)));
}

/// A model of a graph with these fields.
inline std::string OnnxModel(const std::string& graph, int64_t opset = 13) {
  return IntegerField(1, 7) + BytesField(8, BytesField(1, "") + IntegerField(2, opset)) + BytesField(7, graph);
}

/// y = a 3 x 3 convolution of ones of the image x, (N, 1, H, W).
inline std::string OnesModel(int64_t side = 3) {
  return OnnxModel(BytesField(1, OnnxNode("Conv", {"x", "w"}, "y", IntegersAttribute("pads", {1, 1, 1, 1}))) +
                   BytesField(2, "ones") + BytesField(5, OnnxTensor("w", {1, 1, 3, 3}, std::vector<float>(9, 1))) +
                   BytesField(11, OnnxValue("x", {-1, 1, side, side})) +
                   BytesField(12, OnnxValue("y", {-1, 1, side, side})));
}

}  // namespace daumier::runtime
