#!/usr/bin/env bash
# oneDNN 2.6.3 (Debian 12: libdnnl-dev 2.6.3-1), CPU, one thread: PReLU as a post-op of a convolution.
#
# Expected: fusing an activation into a convolution costs about nothing, as ReLU does. append_prelu is part of the interface, the
#   primitive is created without a warning, and its results are right.
# Behaviour: with a PReLU post-op the whole convolution runs the reference code, plain loops, over a hundred times slower. Only
#   impl_info_str() shows it. The same PReLU as a primitive of its own is fast.
# Output seen (3x3 convolution of 32 to 32 channels on 32 x 32, layouts "any"):
#   convolution              jit:avx2             0.19 ms
#   with ReLU                jit:avx2             0.20 ms
#   with PReLU               ref:any            225.23 ms
#   largest error of the PReLU 1.8e-07
# Exit: 0 as described, 1 changed, 2 no packages.
set -euo pipefail
folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT
cd "$folder"
apt-get download -qq libdnnl-dev=2.6.3-1 libdnnl2=2.6.3-1 ocl-icd-libopencl1=2.3.1-1 2>/dev/null ||
  { echo "the pinned packages of Debian 12 cannot be had here; this system has libdnnl2 $(dpkg-query -W -f '${Version}' libdnnl2 2>/dev/null || echo 'not at all')"; exit 2; }
for package in *.deb; do dpkg -x "$package" .; done
libraries="$folder/usr/lib/$(gcc -print-multiarch)"

cat >main.cpp <<'CPP'
#include <dnnl.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>
#include <unordered_map>
#include <vector>

using namespace dnnl;
using tag = memory::format_tag;
constexpr auto f32 = memory::data_type::f32;
const memory::dims kImage = {1, 32, 32, 32}, kKernel = {32, 32, 3, 3}, kSlopes = {1, 32, 1, 1};

engine cpu(engine::kind::cpu, 0);
stream queue(cpu);

memory Reordered(memory from, const memory::desc& to) {
  memory result(to, cpu);
  reorder(from, result).execute(queue, from, result);
  queue.wait();
  return result;
}

memory Filled(const memory::dims& dims, tag layout, float scale) {
  memory result({dims, f32, layout}, cpu);
  const size_t count = result.get_desc().get_size() / sizeof(float);
  auto* const values = static_cast<float*>(result.get_data_handle());
  for (size_t i = 0; i < count; ++i) values[i] = scale * float(int(i * 37 % 101) - 50);
  return result;
}

struct Outcome {
  std::string implementation;
  double milliseconds;
  std::vector<float> values;
};

enum class Fused { kNothing, kRelu, kPrelu };

Outcome Run(Fused fused) {
  post_ops ops;
  if (fused == Fused::kRelu) ops.append_eltwise(1, algorithm::eltwise_relu, 0, 0);
  if (fused == Fused::kPrelu) ops.append_prelu(1 << 1);  // One slope a channel.
  primitive_attr attributes;
  attributes.set_post_ops(ops);
  const auto any = [](const memory::dims& dims) { return memory::desc(dims, f32, tag::any); };
  const convolution_forward::desc description(prop_kind::forward_inference, algorithm::convolution_direct, any(kImage),
                                              any(kKernel), any(kImage), {1, 1}, {1, 1}, {1, 1});
  const convolution_forward::primitive_desc details(description, attributes, cpu);
  memory image = Reordered(Filled(kImage, tag::nchw, 0.01f), details.src_desc());
  memory kernel = Reordered(Filled(kKernel, tag::oihw, 0.001f), details.weights_desc());
  memory slopes = Filled(kSlopes, tag::nchw, 0.02f), result(details.dst_desc(), cpu);
  std::unordered_map<int, memory> arguments = {{DNNL_ARG_SRC, image}, {DNNL_ARG_WEIGHTS, kernel}, {DNNL_ARG_DST, result}};
  if (fused == Fused::kPrelu) arguments.insert({DNNL_ARG_ATTR_MULTIPLE_POST_OP(0) | DNNL_ARG_WEIGHTS, slopes});
  const convolution_forward convolution(details);
  double best = 1e9;
  for (int i = 0; i < 4; ++i) {
    const auto start = std::chrono::steady_clock::now();
    convolution.execute(queue, arguments);
    queue.wait();
    best = std::min(best, std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
  }
  memory plain = Reordered(result, {kImage, f32, tag::nchw});
  const auto* const values = static_cast<const float*>(plain.get_data_handle());
  return {details.impl_info_str(), best, {values, values + 32 * 32 * 32}};
}

bool IsReference(const Outcome& outcome) { return outcome.implementation.rfind("ref", 0) == 0; }

int main() {
  const Outcome plain = Run(Fused::kNothing), relu = Run(Fused::kRelu), prelu = Run(Fused::kPrelu);
  const auto print = [](const char* what, const Outcome& outcome) {
    std::printf("%-24s %-16s %8.2f ms\n", what, outcome.implementation.c_str(), outcome.milliseconds);
  };
  print("convolution", plain);
  print("with ReLU", relu);
  print("with PReLU", prelu);
  double error = 0;  // Of the fused one against slopes applied to the plain one: the input is valid.
  for (size_t i = 0; i < plain.values.size(); ++i) {
    const float slope = 0.02f * float(int(i / 1024 * 37 % 101) - 50);
    const double expected = plain.values[i] >= 0 ? plain.values[i] : slope * plain.values[i];
    error = std::max(error, std::abs(expected - prelu.values[i]));
  }
  std::printf("largest error of the PReLU %.1e\n", error);
  const bool as_described = !IsReference(plain) && !IsReference(relu) && IsReference(prelu) && error < 1e-4 &&
                            prelu.milliseconds > 20 * relu.milliseconds;
  std::puts(as_described ? "as described" : "CHANGED");
  return as_described ? 0 : 1;
}
CPP
g++ -std=c++17 -O1 -isystem usr/include main.cpp -o main "$libraries/libdnnl.so" -Wl,-rpath,"$libraries" -Wl,-rpath-link,"$libraries"
OMP_NUM_THREADS=1 ONEDNN_MAX_CPU_ISA=AVX2 ./main
