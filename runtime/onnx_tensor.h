#pragma once
#include "core/safetensors.h"
#include "runtime/graph.h"
#include "runtime/wire_reader.h"

#include <filesystem>
#include <optional>

namespace daumier::runtime {

/// ONNX's numbers of element types.
enum ElementType : int64_t {
  kFloat32 = 1,
  kUint8 = 2,
  kInt8 = 3,
  kUint16 = 4,
  kInt16 = 5,
  kInt32 = 6,
  kInt64 = 7,
  kString = 8,
  kBool = 9,
  kFloat16 = 10,
  kFloat64 = 11,
  kUint32 = 12,
  kUint64 = 13,
  kBfloat16 = 16
};
bool IsRealType(int64_t type);

/// A tensor as an ONNX file has it (TensorProto), before its numbers are converted.
struct StoredTensor {
  std::string name;
  Shape shape;
  int64_t type = 0;
  std::string_view raw;                ///< All numbers, little-endian; or they are in one of the three lists.
  std::vector<float> floats = {};      ///< float_data
  std::vector<double> doubles = {};    ///< double_data
  std::vector<int64_t> integers = {};  ///< int32_data, int64_data, uint64_data; of float16 the bits.
  std::string location = {};           ///< Of external data.
  bool is_external = false;
};

/// @throws Error if it is malformed, has more than kMostDimensions, or has strings.
StoredTensor StoredTensorOf(WireReader tensor);

/// Reads tensors in the file and in safetensors files next to it, each of which is opened once. Real numbers become
/// float32, all others int64.
class TensorReader {
 public:
  explicit TensorReader(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// @throws Error naming the tensor: another element type, bytes that do not fill the shape, external data that are
  /// not float16 or float32 in a safetensors file of the same folder.
  GraphTensor Read(const StoredTensor& stored);

 private:
  std::vector<float> External(const StoredTensor& stored);

  std::filesystem::path folder_, location_;
  std::optional<SafetensorsFile> file_;
};

}  // namespace daumier::runtime
