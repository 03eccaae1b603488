#pragma once
#include "runtime/graph.h"

#include <filesystem>

namespace daumier::runtime {

/// Reads an ONNX file: what `daumier export` writes, and networks of other programs (docs/runtime.md lists operators and
/// their sets). Nodes are brought into one form (runtime/operator_sets.h). Numbers of float16, bfloat16 and float64 become
/// float32, whole numbers and booleans int64. Tensors whose data are external, and whose location is a safetensors file of
/// the same folder, are read there by their names, in float16 or float32.
/// @throws Error naming the file and the cause: malformed, an operator set before 9 or after 21, an operator of another
/// domain, subgraphs, inputs of whole numbers other than uint8, external data elsewhere, and as AddNode and CheckGraph.
Graph ReadOnnx(const std::filesystem::path& file);

}  // namespace daumier::runtime
