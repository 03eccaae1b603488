// A frame of a rig's animation, S = S_0 + B beta, on one core: our sparse sum, and Eigen's dense product of the same
// numbers, with 20 and with all 52 weights above zero. The paper states 3.56 ms [Pan et al. 2024, section 4.5].
#include "core/random.h"
#include "faces/face_model_file.h"
#include "rig/blend.h"
#include "rig/expression_targets.h"
#include "tests/support/paths.h"

#include <benchmark/benchmark.h>

namespace {

using namespace daumier;

/// The 52 targets of the shipped face model's mean face, 10,350 vertices.
struct MeanRig {
  geometry::Points neutral;
  rig::MorphTargets targets;

  MeanRig() {
    const faces::FaceModel model = faces::ReadFaceModelWeights(testing::SourceRoot() / "weights/face-ict");
    neutral = model.face_template.neutral;
    targets = rig::ExpressionTargets(model).On(neutral);
  }
};

const MeanRig& Rig() {
  static const MeanRig rig;
  return rig;
}

/// `count` weights of different targets are not 0.
std::vector<float> DrawWeights(int num_targets, int count) {
  Rng rng(1);
  std::vector<float> weights(size_t(num_targets), 0.0f);
  const std::vector<int> order = rng.Permutation(num_targets);
  for (int i = 0; i < count; ++i) weights[size_t(order[size_t(i)])] = float(rng.Uniform(0.1, 1));
  return weights;
}

void SparseSum(benchmark::State& state) {
  const rig::Blend blend(Rig().neutral, Rig().targets);
  const std::vector<float> weights = DrawWeights(blend.num_targets(), int(state.range(0)));
  std::vector<float> positions(size_t(3 * blend.num_vertices()));
  for (auto _ : state) {
    blend.Apply(weights, positions);
    benchmark::DoNotOptimize(positions.data());
    benchmark::ClobberMemory();
  }
  state.counters["MB"] = double(blend.num_bytes()) / 1e6;
}
BENCHMARK(SparseSum)->Arg(20)->Arg(52)->Unit(benchmark::kMillisecond);

void DenseProduct(benchmark::State& state) {
  const Eigen::MatrixXf& offsets = Rig().targets.offsets;
  const Eigen::VectorXf rest =
      Eigen::Map<const Eigen::VectorXd>(Rig().neutral.data(), Rig().neutral.size()).cast<float>();
  const std::vector<float> drawn = DrawWeights(int(offsets.cols()), int(state.range(0)));
  const Eigen::VectorXf weights = Eigen::Map<const Eigen::VectorXf>(drawn.data(), offsets.cols());
  Eigen::VectorXf positions(rest.size());
  for (auto _ : state) {
    positions = rest;
    positions.noalias() += offsets * weights;
    benchmark::DoNotOptimize(positions.data());
    benchmark::ClobberMemory();
  }
}
BENCHMARK(DenseProduct)->Arg(20)->Arg(52)->Unit(benchmark::kMillisecond);

}  // namespace
