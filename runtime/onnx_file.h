#pragma once
#include "runtime/graph.h"

#include <filesystem>

namespace daumier::runtime {

/// Reads an ONNX file of the operators' set 13, as `daumier export` writes it. Tensors whose data are external, and whose
/// location is a safetensors file of the same folder, are read there by their names, in float16 or float32.
/// @throws Error naming the file and the cause: malformed, another operator set, an operator of another domain,
/// subgraphs, element types other than float32 and int64, an external tensor of another shape, and as CheckGraph.
Graph ReadOnnx(const std::filesystem::path& file);

}  // namespace daumier::runtime
