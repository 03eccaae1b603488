#include "runtime/primitives.h"

#include "core/error.h"

#include <dlfcn.h>

#include <utility>

namespace daumier::runtime {
namespace {

using dnnl::algorithm;
using dnnl::memory;

constexpr auto kForward = dnnl::prop_kind::forward_inference;
constexpr auto kFloat = memory::data_type::f32;

/// A stream of the CPU holds no state of its own: one serves all threads.
const dnnl::stream& CpuStream() {
  static const dnnl::stream stream(CpuEngine());
  return stream;
}

dnnl::primitive_attr Attributes(const Epilogue& epilogue = {}) {
  dnnl::post_ops operations;
  if (epilogue.sum) operations.append_sum(1);
  const auto append = [&](algorithm what, float alpha) {
#if DNNL_VERSION_MAJOR >= 3
    operations.append_eltwise(what, alpha, 0);
#else
    operations.append_eltwise(1, what, alpha, 0);
#endif
  };
  if (epilogue.activation == "Relu" || epilogue.activation == "LeakyRelu")
    append(algorithm::eltwise_relu, epilogue.alpha);
  if (epilogue.activation == "Sigmoid") append(algorithm::eltwise_logistic, 0);
  if (epilogue.activation == "Tanh") append(algorithm::eltwise_tanh, 0);
  dnnl::primitive_attr attributes;
  attributes.set_post_ops(operations);
  attributes.set_scratchpad_mode(dnnl::scratchpad_mode::user);
  return attributes;
}

/// oneDNN counts dilations from 0.
memory::dims Dilations(const Window& window) {
  memory::dims dilations = window.dilations;
  for (int64_t& dilation : dilations) --dilation;
  return dilations;
}

#if DNNL_VERSION_MAJOR >= 3
template <class Operator, class... Arguments>
typename Operator::primitive_desc Describe(const dnnl::primitive_attr& attributes, Arguments&&... arguments) {
  return {CpuEngine(), std::forward<Arguments>(arguments)..., attributes};
}
#else
template <class Operator, class... Arguments>
typename Operator::primitive_desc Describe(const dnnl::primitive_attr& attributes, Arguments&&... arguments) {
  return {typename Operator::desc(std::forward<Arguments>(arguments)...), attributes, CpuEngine()};
}
#endif

/// Makes a primitive by `describe`, with oneDNN's refusals in our words.
template <class Operator, class DescribeIt>
Primitive Made(const char* what, const DescribeIt& describe) {
  try {
    const typename Operator::primitive_desc desc = describe();
    return {Operator(desc),
            desc.query_md(dnnl::query::src_md),
            desc.query_md(dnnl::query::weights_md, 0),
            desc.query_md(dnnl::query::weights_md, 1),
            desc.query_md(dnnl::query::dst_md),
            desc.scratchpad_desc(),
            desc.impl_info_str()};
  } catch (const dnnl::error& error) {
    throw Error(fmt::format("oneDNN refuses this {}: {}", what, error.what()));
  }
}

}  // namespace

const dnnl::engine& CpuEngine() {
  static const dnnl::engine engine(dnnl::engine::kind::cpu, 0);
  return engine;
}

int OpenMpThreads() {
  static const auto get = reinterpret_cast<int (*)()>(dlsym(RTLD_DEFAULT, "omp_get_max_threads"));
  return get == nullptr ? 1 : get();
}

Layout PlainLayout(const Shape& shape) {
  if (shape.empty()) return Layout({1}, kFloat, memory::dims{1});
  memory::dims strides(shape.size(), 1);
  for (size_t i = shape.size() - 1; i > 0; --i) strides[i - 1] = strides[i] * shape[i];
  return Layout(shape, kFloat, strides);
}

Layout AnyLayout(const Shape& shape) {
  return Layout(shape, kFloat, memory::format_tag::any);
}

Layout BlockedLayout(const Shape& shape, int block) {
  using tag = memory::format_tag;
  if (block == 1) return PlainLayout(shape);
  const bool is_row = shape.size() == 3;
  if (block == 8) return Layout(shape, kFloat, is_row ? tag::nCw8c : tag::nChw8c);
  return Layout(shape, kFloat, is_row ? tag::nCw16c : tag::nChw16c);
}

int BlockOf(const Layout& layout, const Shape& shape) {
  if (layout == PlainLayout(shape)) return 1;
  if (shape.size() != 3 && shape.size() != 4) return 0;
  for (const int block : {8, 16})
    if (layout == BlockedLayout(shape, block)) return block;
  return 0;
}

Primitive MakeConvolution(const Layout& source, const Layout& weights, const Layout& bias, const Layout& target,
                          const Window& window, const Epilogue& epilogue) {
  using Operator = dnnl::convolution_forward;
  return Made<Operator>("convolution", [&] {
    return Describe<Operator>(Attributes(epilogue), kForward, algorithm::convolution_direct, source, weights, bias,
                              target, memory::dims(window.strides), Dilations(window), memory::dims(window.before),
                              memory::dims(window.after));
  });
}

Primitive MakeDeconvolution(const Layout& source, const Layout& weights, const Layout& bias, const Layout& target,
                            const Window& window) {
  using Operator = dnnl::deconvolution_forward;
  return Made<Operator>("transposed convolution", [&] {
    return Describe<Operator>(Attributes(), kForward, algorithm::deconvolution_direct, source, weights, bias, target,
                              memory::dims(window.strides), Dilations(window), memory::dims(window.before),
                              memory::dims(window.after));
  });
}

Primitive MakePool(const Layout& source, const Layout& target, const Window& window, PoolKind kind) {
  const algorithm what = kind == PoolKind::kMax    ? algorithm::pooling_max
                         : kind == PoolKind::kMean ? algorithm::pooling_avg_exclude_padding
                                                   : algorithm::pooling_avg_include_padding;
#if DNNL_VERSION_MAJOR >= 3
  using Operator = dnnl::pooling_forward;
#else
  using Operator = dnnl::pooling_v2_forward;
#endif
  return Made<Operator>("pooling", [&] {
    return Describe<Operator>(Attributes(), kForward, what, source, target, memory::dims(window.strides),
                              memory::dims(window.kernel), Dilations(window), memory::dims(window.before),
                              memory::dims(window.after));
  });
}

Primitive MakeLinearResize(const Layout& source, const Layout& target) {
  using Operator = dnnl::resampling_forward;
  return Made<Operator>("resize", [&] {
    return Describe<Operator>(Attributes(), kForward, algorithm::resampling_linear, source, target);
  });
}

Primitive MakeProduct(const Layout& a, const Layout& b, const Layout& bias, const Layout& target,
                      const Epilogue& epilogue) {
  using Operator = dnnl::matmul;
  return Made<Operator>("product of matrices",
                        [&] { return Describe<Operator>(Attributes(epilogue), a, b, bias, target); });
}

Primitive MakeReorder(const Layout& source, const Layout& target) {
  try {
    const dnnl::reorder::primitive_desc desc(CpuEngine(), source, CpuEngine(), target, Attributes());
    return {dnnl::reorder(desc), source, {}, {}, target, desc.scratchpad_desc(), desc.impl_info_str()};
  } catch (const dnnl::error& error) {
    throw Error(fmt::format("oneDNN refuses a change of layout: {}", error.what()));
  }
}

void Execute(const dnnl::primitive& primitive, const std::unordered_map<int, dnnl::memory>& arguments,
             const std::string& node) {
  try {
    primitive.execute(CpuStream(), arguments);
  } catch (const dnnl::error& error) {
    throw Error(fmt::format("{} failed in oneDNN: {}", node, error.what()));
  }
}

}  // namespace daumier::runtime
