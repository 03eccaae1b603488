#pragma once
#include "runtime/graph.h"

namespace daumier::runtime {

/// What Fused adds to nodes of Conv and Gemm: the operator that follows, of kActivations, with its alpha; and of Conv the
/// input `kAddend`, which is added before it. InstanceNormalization may be followed by Relu.
inline constexpr const char* kActivation = "fused_activation";
inline constexpr const char* kActivationAlpha = "fused_alpha";
inline constexpr size_t kAddend = 3;

/// The same function by fewer nodes: batch norms go into the convolutions before them, sums and activations become part
/// of the convolutions and products before them, norms of groups that are written as norms of images become their own
/// operator, identities vanish. Only values that nothing else reads vanish. The
/// graph has passed CheckGraph.
Graph Fused(Graph graph);

}  // namespace daumier::runtime
