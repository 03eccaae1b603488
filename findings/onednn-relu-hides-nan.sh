#!/usr/bin/env bash
# oneDNN 2.6.3 (Debian 12: libdnnl-dev 2.6.3-1), CPU: NaN through activations and max pooling.
#
# Expected: NaN in, NaN out, as in IEEE arithmetic and in LibTorch's relu and max_pool2d, so that a NaN in weights or
# input is
#   seen in the result of a network.
# Behaviour: relu(NaN) = 0, and max pooling skips a NaN next to a number. Leaky ReLU, tanh and the logistic function
# keep it. A network
#   of convolutions with ReLU thus returns finite numbers where a part of it is NaN.
# Output seen:
#   relu(NaN) = 0, leaky relu nan, tanh nan, logistic -nan
#   max of NaN, 1, 2, 3 = 3          the same code paths of SSE4.1 and AVX2
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

#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

using namespace dnnl;
constexpr auto f32 = memory::data_type::f32;
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

engine cpu(engine::kind::cpu, 0);
stream queue(cpu);

float Eltwise(algorithm kind, float alpha, float beta) {
  std::vector<float> in(16, kNaN), out(16);
  const memory::desc shape({1, 16, 1, 1}, f32, memory::format_tag::nchw);
  memory source(shape, cpu, in.data()), result(shape, cpu, out.data());
  const eltwise_forward::primitive_desc details({prop_kind::forward_inference, kind, shape, alpha, beta}, cpu);
  eltwise_forward(details).execute(queue, {{DNNL_ARG_SRC, source}, {DNNL_ARG_DST, result}});
  queue.wait();
  return out[0];
}

/// The maximum of 2 x 2 numbers of which the first is NaN and the largest other is 3.
float MaxPool() {
  std::vector<float> in = {kNaN, 1, 2, 3}, out(1);
  const memory::desc from({1, 1, 2, 2}, f32, memory::format_tag::nchw), to({1, 1, 1, 1}, f32, memory::format_tag::nchw);
  memory source(from, cpu, in.data()), result(to, cpu, out.data());
  const pooling_forward::primitive_desc details(
      {prop_kind::forward_inference, algorithm::pooling_max, from, to, {2, 2}, {2, 2}, {0, 0}, {0, 0}}, cpu);
  pooling_forward(details).execute(queue, {{DNNL_ARG_SRC, source}, {DNNL_ARG_DST, result}});
  queue.wait();
  return out[0];
}

int main() {
  const float relu = Eltwise(algorithm::eltwise_relu, 0, 0), leaky = Eltwise(algorithm::eltwise_relu, 0.1f, 0);
  const float tanh = Eltwise(algorithm::eltwise_tanh, 0, 0), logistic = Eltwise(algorithm::eltwise_logistic, 0, 0);
  const float pooled = MaxPool();
  std::printf("relu(NaN) = %g, leaky relu %g, tanh %g, logistic %g\n", relu, leaky, tanh, logistic);
  std::printf("max of NaN, 1, 2, 3 = %g\n", pooled);
  const bool as_described = relu == 0 && std::isnan(leaky) && std::isnan(tanh) && std::isnan(logistic) && pooled == 3;
  std::puts(as_described ? "as described" : "CHANGED");
  return as_described ? 0 : 1;
}
CPP
g++ -std=c++17 -O1 -isystem usr/include main.cpp -o main "$libraries/libdnnl.so" -Wl,-rpath,"$libraries" -Wl,-rpath-link,"$libraries"
for isa in SSE41 AVX2; do
  echo "$isa:"
  ONEDNN_MAX_CPU_ISA=$isa ./main
done
