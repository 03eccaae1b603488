#pragma once
#include "runtime/graph.h"

#include <dnnl.hpp>

#include <string>
#include <vector>

/// oneDNN's operators as we use them: the one place that depends on its versions 2 and 3. What it refuses is a daumier::Error.
namespace daumier::runtime {

using Layout = dnnl::memory::desc;

const dnnl::engine& CpuEngine();

/// The threads with which a primitive that is made now computes: OpenMP's of this thread.
int OpenMpThreads();

/// Row by row without gaps, which is ONNX's own order.
Layout PlainLayout(const Shape& shape);
/// Whatever the primitive likes best.
Layout AnyLayout(const Shape& shape);
/// Images (N, C, W) or (N, C, H, W) in blocks of `block` channels: nChw8c; block 1: plain.
Layout BlockedLayout(const Shape& shape, int block);
/// 1, 8 or 16 if the layout is that of BlockedLayout; 0 for any other.
int BlockOf(const Layout& layout, const Shape& shape);

/// A primitive with the layouts that it has chosen. Scratch memory is its user's.
struct Primitive {
  dnnl::primitive primitive;
  Layout source, weights, bias, target, scratch;
  std::string kernel;  ///< Which code it runs: "jit:avx2".
};

/// Of a window that moves over an image; one number for each axis of the image, dilations 1 where there are none.
struct Window {
  std::vector<int64_t> kernel, strides, dilations, before, after;
};

/// What follows a convolution or product in the same primitive: target = f(result + target).
struct Epilogue {
  bool sum = false;
  std::string activation = {};  ///< "Relu", "LeakyRelu", "Sigmoid", "Tanh"; empty: none.
  float alpha = 0;
};

/// weights: (O, I, ...) or (G, O/G, I/G, ...); bias: empty where there is none.
Primitive MakeConvolution(const Layout& source, const Layout& weights, const Layout& bias, const Layout& target,
                          const Window& window, const Epilogue& epilogue);
Primitive MakeDeconvolution(const Layout& source, const Layout& weights, const Layout& bias, const Layout& target,
                            const Window& window);
enum class PoolKind { kMax, kMean, kMeanWithPadding };  ///< kMean leaves out padding.
Primitive MakePool(const Layout& source, const Layout& target, const Window& window, PoolKind kind);
/// Bilinear, with pixels' centres at half numbers.
Primitive MakeLinearResize(const Layout& source, const Layout& target);
Primitive MakeProduct(const Layout& a, const Layout& b, const Layout& bias, const Layout& target,
                      const Epilogue& epilogue);
Primitive MakeReorder(const Layout& source, const Layout& target);

/// Runs on the calling thread. @throws Error naming the node if oneDNN fails.
void Execute(const dnnl::primitive& primitive, const std::unordered_map<int, dnnl::memory>& arguments,
             const std::string& node);

}  // namespace daumier::runtime
