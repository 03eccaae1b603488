#include "runtime/onnx_file.h"

#include "core/error.h"
#include "core/files.h"
#include "core/safetensors.h"
#include "runtime/wire_reader.h"

#include <algorithm>
#include <cstring>
#include <optional>

namespace daumier::runtime {
namespace {

namespace fs = std::filesystem;

constexpr int64_t kReadOpset = 13;
enum ElementType : int64_t { kFloat32 = 1, kInt64 = 7 };
enum AttributeType : int64_t { kReal = 1, kInteger = 2, kText = 3, kIntegers = 7 };

std::string TextOfField(const WireReader& field) {
  return std::string(field.Bytes());
}

/// {key, value} of ONNX's StringStringEntryProto.
std::pair<std::string, std::string> EntryOf(WireReader entry) {
  std::pair<std::string, std::string> pair;
  while (entry.Next()) {
    if (entry.field() == 1) pair.first = TextOfField(entry);
    if (entry.field() == 2) pair.second = TextOfField(entry);
  }
  return pair;
}

/// A tensor as the file has it, before its numbers are read.
struct StoredTensor {
  std::string name;
  Shape shape;
  int64_t type = 0;
  std::string_view raw;
  std::string location;  ///< Of external data.
  bool is_external = false;
};

StoredTensor StoredTensorOf(WireReader tensor) {
  StoredTensor stored;
  while (tensor.Next()) {
    switch (tensor.field()) {
      case 1:
        tensor.Integers([&](int64_t size) { stored.shape.push_back(size); });
        DAUMIER_CHECK(stored.shape.size() <= kMostDimensions, "a tensor has more than {} dimensions", kMostDimensions);
        break;
      case 2:
        stored.type = tensor.Integer();
        break;
      case 8:
        stored.name = TextOfField(tensor);
        break;
      case 9:
        stored.raw = tensor.Bytes();
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
      case 4:
      case 5:
      case 6:
      case 7:
      case 10:
      case 11:
        throw Error(
            fmt::format("the tensor '{}' has data in field {} (only raw_data are read)", stored.name, tensor.field()));
      default:
        break;
    }
  }
  return stored;
}

template <class T>
std::vector<T> RawNumbers(const StoredTensor& stored) {
  const int64_t size = CheckedSize(stored.shape, fmt::format("the tensor '{}'", stored.name));
  DAUMIER_CHECK(stored.raw.size() == size_t(size) * sizeof(T), "the tensor '{}' has {} bytes, expected {} for {}",
                stored.name, stored.raw.size(), size_t(size) * sizeof(T), ShapeText(stored.shape));
  std::vector<T> numbers(static_cast<size_t>(size));
  if (size > 0) std::memcpy(numbers.data(), stored.raw.data(), stored.raw.size());
  return numbers;
}

/// Reads tensors in the file and in safetensors files next to it, each of which is opened once.
class TensorReader {
 public:
  explicit TensorReader(fs::path folder) : folder_(std::move(folder)) {}

  GraphTensor Read(const StoredTensor& stored) {
    GraphTensor tensor{.shape = stored.shape};
    if (stored.type == kInt64) {
      DAUMIER_CHECK(!stored.is_external, "the tensor '{}' of integers is external", stored.name);
      tensor.integers = RawNumbers<int64_t>(stored);
      tensor.has_integers = true;
      return tensor;
    }
    DAUMIER_CHECK(stored.type == kFloat32,
                  "the tensor '{}' has the element type {} (float32, 1, and int64, 7, are read)", stored.name,
                  stored.type);
    tensor.numbers = stored.is_external ? External(stored) : RawNumbers<float>(stored);
    return tensor;
  }

 private:
  std::vector<float> External(const StoredTensor& stored) {
    const fs::path location = stored.location;
    DAUMIER_CHECK(!location.empty() && location == location.filename() && location.extension() == ".safetensors",
                  "the tensor '{}' lies in '{}' (expected a safetensors file of the same folder)", stored.name,
                  stored.location);
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

  fs::path folder_, location_;
  std::optional<SafetensorsFile> file_;
};

std::pair<std::string, GraphAttribute> AttributeOf(WireReader attribute) {
  std::string name, text;
  int64_t integer = 0, type = 0;
  float real = 0;
  std::vector<int64_t> integers;
  while (attribute.Next()) {
    switch (attribute.field()) {
      case 1:
        name = TextOfField(attribute);
        break;
      case 2:
        real = attribute.Real();
        break;
      case 3:
        integer = attribute.Integer();
        break;
      case 4:
        text = TextOfField(attribute);
        break;
      case 8:
        attribute.Integers([&](int64_t value) { integers.push_back(value); });
        break;
      case 20:
        type = attribute.Integer();
        break;
      default:
        break;
    }
  }
  switch (type) {
    case kReal:
      return {name, real};
    case kInteger:
      return {name, integer};
    case kText:
      return {name, text};
    case kIntegers:
      return {name, integers};
    default:
      throw Error(fmt::format("the attribute '{}' has the type {}, which is not read", name, type));
  }
}

GraphNode NodeOf(WireReader node) {
  GraphNode read;
  std::vector<std::string> outputs;
  std::string domain;
  while (node.Next()) {
    switch (node.field()) {
      case 1:
        read.inputs.push_back(TextOfField(node));
        break;
      case 2:
        outputs.push_back(TextOfField(node));
        break;
      case 3:
        read.name = TextOfField(node);
        break;
      case 4:
        read.op = TextOfField(node);
        break;
      case 5:
        read.attributes.insert(AttributeOf(node.Message()));
        break;
      case 7:
        domain = TextOfField(node);
        break;
      default:
        break;
    }
  }
  DAUMIER_CHECK(domain.empty() || domain == "ai.onnx", "{} is of the domain '{}'", read.Text(), domain);
  DAUMIER_CHECK(outputs.size() == 1, "{} has {} outputs, expected one", read.Text(), outputs.size());
  read.output = outputs.front();
  return read;
}

/// Name and shape of a ValueInfoProto.
GraphInput InputOf(WireReader info) {
  GraphInput input;
  int64_t type = 0;
  while (info.Next()) {
    if (info.field() == 1) input.name = TextOfField(info);
    if (info.field() != 2) continue;
    WireReader value = info.Message();
    while (value.Next()) {
      DAUMIER_CHECK(value.field() == 1, "the input '{}' is no tensor", input.name);
      WireReader tensor = value.Message();
      while (tensor.Next()) {
        if (tensor.field() == 1) type = tensor.Integer();
        if (tensor.field() != 2) continue;
        WireReader shape = tensor.Message();
        while (shape.Next()) {
          if (shape.field() != 1) continue;
          int64_t size = -1;
          WireReader dimension = shape.Message();
          while (dimension.Next())
            if (dimension.field() == 1) size = dimension.Integer();
          input.shape.push_back(size);
          DAUMIER_CHECK(size >= -1 && input.shape.size() <= kMostDimensions, "the input '{}' has the shape {}",
                        input.name, ShapeText(input.shape));
        }
      }
    }
  }
  DAUMIER_CHECK(type == kFloat32, "the input '{}' has the element type {}, expected float32", input.name, type);
  return input;
}

Graph GraphOf(WireReader graph, const fs::path& folder) {
  Graph read;
  TensorReader tensors(folder);
  while (graph.Next()) {
    switch (graph.field()) {
      case 1:
        DAUMIER_CHECK(read.nodes.size() < kMostNodes, "the graph has more than {} nodes", kMostNodes);
        read.nodes.push_back(NodeOf(graph.Message()));
        break;
      case 2:
        read.name = TextOfField(graph);
        break;
      case 5: {
        const StoredTensor stored = StoredTensorOf(graph.Message());
        const bool is_new = read.weights.emplace(stored.name, tensors.Read(stored)).second;
        DAUMIER_CHECK(is_new, "the tensor '{}' is stored twice", stored.name);
        break;
      }
      case 11:
        read.inputs.push_back(InputOf(graph.Message()));
        break;
      case 12:
        read.outputs.push_back(InputOf(graph.Message()).name);
        break;
      case 15:
        throw Error("the graph has sparse tensors, which are not read");
      default:
        break;
    }
  }
  return read;
}

void CheckOpset(WireReader opset) {
  std::string domain;
  int64_t version = 0;
  while (opset.Next()) {
    if (opset.field() == 1) domain = TextOfField(opset);
    if (opset.field() == 2) version = opset.Integer();
  }
  DAUMIER_CHECK((domain.empty() || domain == "ai.onnx") && version == kReadOpset,
                "it uses version {} of the operators '{}' (expected version {} of ONNX's own)", version, domain,
                kReadOpset);
}

}  // namespace

Graph ReadOnnx(const fs::path& file) {
  const MappedFile mapped(file);
  try {
    Graph graph;
    bool has_graph = false, has_opset = false;
    WireReader model(mapped.bytes());
    while (model.Next()) {
      if (model.field() == 7) {
        DAUMIER_CHECK(!has_graph, "it has two graphs");
        graph = GraphOf(model.Message(), file.parent_path());
        has_graph = true;
      }
      if (model.field() == 8) {
        CheckOpset(model.Message());
        has_opset = true;
      }
    }
    DAUMIER_CHECK(has_graph && has_opset, "it holds no graph of ONNX");
    CheckGraph(graph);
    return graph;
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}. Write it again by `daumier export`", file.string(), error.what()));
  }
}

}  // namespace daumier::runtime
