#include "runtime/onnx_file.h"

#include "core/error.h"
#include "core/files.h"
#include "runtime/onnx_tensor.h"
#include "runtime/operator_sets.h"

#include <algorithm>

namespace daumier::runtime {
namespace {

namespace fs = std::filesystem;

enum AttributeType : int64_t { kReal = 1, kInteger = 2, kText = 3, kTensor = 4, kReals = 6, kIntegers = 7 };

bool IsOwnDomain(const std::string& domain) {
  return domain.empty() || domain == "ai.onnx";
}

std::string TextOfField(const WireReader& field) {
  return std::string(field.Bytes());
}

std::pair<std::string, GraphAttribute> AttributeOf(WireReader attribute, TensorReader& tensors) {
  std::string name, text;
  int64_t integer = 0, type = 0;
  float real = 0;
  std::vector<int64_t> integers;
  std::vector<float> reals;
  StoredTensor tensor;
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
      case 5:
        tensor = StoredTensorOf(attribute.Message());
        break;
      case 7:
        attribute.Numbers<float>([&](float value) { reals.push_back(value); });
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
    case kTensor:
      return {name, tensors.Read(tensor)};
    case kReals:
      return {name, reals};
    case kIntegers:
      return {name, integers};
    default:
      throw Error(fmt::format("the attribute '{}' has the type {}, which is not read", name, type));
  }
}

StoredNode NodeOf(WireReader node, TensorReader& tensors) {
  StoredNode read;
  GraphNode& form = read.node;
  std::string domain;
  std::vector<WireReader> attributes;
  while (node.Next()) {
    switch (node.field()) {
      case 1:
        form.inputs.push_back(TextOfField(node));
        break;
      case 2:
        read.outputs.push_back(TextOfField(node));
        break;
      case 3:
        form.name = TextOfField(node);
        break;
      case 4:
        form.op = TextOfField(node);
        break;
      case 5:
        attributes.push_back(node.Message());
        break;
      case 7:
        domain = TextOfField(node);
        break;
      default:
        break;
    }
  }
  if (form.name.empty() && !read.outputs.empty()) form.name = read.outputs.front();
  DAUMIER_CHECK(IsOwnDomain(domain), "{} is of the domain '{}' (ONNX's own operators are read)", form.Text(), domain);
  try {
    for (const WireReader& attribute : attributes) form.attributes.insert(AttributeOf(attribute, tensors));
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", form.Text(), error.what()));
  }
  return read;
}

/// Name, shape and element type of a ValueInfoProto.
struct StoredPort {
  GraphInput input;
  int64_t type = 0;
};

StoredPort PortOf(WireReader info) {
  StoredPort port;
  GraphInput& input = port.input;
  while (info.Next()) {
    if (info.field() == 1) input.name = TextOfField(info);
    if (info.field() != 2) continue;
    WireReader value = info.Message();
    while (value.Next()) {
      DAUMIER_CHECK(value.field() == 1, "the input '{}' is no tensor", input.name);
      WireReader tensor = value.Message();
      while (tensor.Next()) {
        if (tensor.field() == 1) port.type = tensor.Integer();
        if (tensor.field() != 2) continue;
        WireReader shape = tensor.Message();
        while (shape.Next()) {
          if (shape.field() != 1) continue;
          int64_t size = -1;
          WireReader dimension = shape.Message();
          while (dimension.Next())
            if (dimension.field() == 1 && dimension.Integer() != 0) size = dimension.Integer();  // 0: free, too.
          input.shape.push_back(size);
          DAUMIER_CHECK(size >= -1 && input.shape.size() <= kMostDimensions, "the input '{}' has the shape {}",
                        input.name, ShapeText(input.shape));
        }
      }
    }
  }
  return port;
}

GraphInput InputOf(StoredPort port) {
  DAUMIER_CHECK(IsRealType(port.type) || port.type == kUint8,
                "the input '{}' has the element type {} (float32 is read, and what can be given in it)",
                port.input.name, port.type);
  port.input.is_bytes = port.type == kUint8;
  return port.input;
}

/// A graph whose nodes are still those of its operator set.
struct StoredGraph {
  Graph graph;
  std::vector<StoredPort> inputs;
  std::vector<StoredNode> nodes;
};

StoredGraph GraphOf(WireReader graph, const fs::path& folder) {
  StoredGraph stored;
  Graph& read = stored.graph;
  TensorReader tensors(folder);
  while (graph.Next()) {
    switch (graph.field()) {
      case 1:
        DAUMIER_CHECK(stored.nodes.size() < kMostNodes, "the graph has more than {} nodes", kMostNodes);
        stored.nodes.push_back(NodeOf(graph.Message(), tensors));
        break;
      case 2:
        read.name = TextOfField(graph);
        break;
      case 5: {
        const StoredTensor tensor = StoredTensorOf(graph.Message());
        const bool is_new = read.weights.emplace(tensor.name, tensors.Read(tensor)).second;
        DAUMIER_CHECK(is_new, "the tensor '{}' is stored twice", tensor.name);
        break;
      }
      case 11:
        stored.inputs.push_back(PortOf(graph.Message()));
        break;
      case 12:
        read.outputs.push_back(PortOf(graph.Message()).input.name);
        break;
      case 15:
        throw Error("the graph has sparse tensors, which are not read");
      default:
        break;
    }
  }
  return stored;
}

Graph InOurForm(StoredGraph stored, int64_t operator_set) {
  Graph graph = std::move(stored.graph);
  for (StoredPort& port : stored.inputs)  // Files of IR version 3 list weights among the inputs.
    if (!graph.weights.contains(port.input.name)) graph.inputs.push_back(InputOf(std::move(port)));
  for (StoredNode& node : stored.nodes) AddNode(std::move(node), operator_set, graph);
  return graph;
}

/// The version of ONNX's own operators, or 0 if the entry is of others.
int64_t OperatorSetOf(WireReader opset) {
  std::string domain;
  int64_t version = 0;
  while (opset.Next()) {
    if (opset.field() == 1) domain = TextOfField(opset);
    if (opset.field() == 2) version = opset.Integer();
  }
  if (!IsOwnDomain(domain)) return 0;  // Exporters list others without using them; a node of theirs is refused.
  DAUMIER_CHECK(version >= kFirstOperatorSet && version <= kLastOperatorSet,
                "it uses version {} of ONNX's operators ({} to {} are read)", version, kFirstOperatorSet,
                kLastOperatorSet);
  return version;
}

}  // namespace

Graph ReadOnnx(const fs::path& file) {
  const MappedFile mapped(file);
  try {
    StoredGraph stored;
    bool has_graph = false;
    int64_t operator_set = 0;
    WireReader model(mapped.bytes());
    while (model.Next()) {
      if (model.field() == 7) {
        DAUMIER_CHECK(!has_graph, "it has two graphs");
        stored = GraphOf(model.Message(), file.parent_path());
        has_graph = true;
      }
      if (model.field() == 8) operator_set = std::max(operator_set, OperatorSetOf(model.Message()));
    }
    DAUMIER_CHECK(has_graph && operator_set > 0, "it holds no graph of ONNX");
    Graph graph = InOurForm(std::move(stored), operator_set);
    CheckGraph(graph);
    return graph;
  } catch (const Error& error) {
    throw Error(
        fmt::format("{}: {}. Write it again by the program that made it (`daumier export`, torch.onnx.export, "
                    "tf2onnx), with operators of set 13",
                    file.string(), error.what()));
  }
}

}  // namespace daumier::runtime
