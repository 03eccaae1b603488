// The fits of the training-free baselines on faces of ICT's size, and a product of theirs by the BLAS and by Eigen.
#include "core/random.h"
#include "eval/principal_components.h"
#include "eval/ridge_regression.h"

#include <benchmark/benchmark.h>

#include <numeric>

namespace daumier::eval {
namespace {

FaceRows RandomRows(Eigen::Index rows, Eigen::Index cols) {
  Rng rng(1);
  FaceRows numbers(rows, cols);
  for (float& number : numbers.reshaped<Eigen::RowMajor>()) number = float(rng.Normal());
  return numbers;
}

void PrincipalComponentsOfFaces(benchmark::State& state) {
  const CentredRows faces = Centre(RandomRows(state.range(0), 34000));
  for (auto _ : state) benchmark::DoNotOptimize(FitPrincipalComponents(faces, 128, 1));
}

void RidgeOnCurvePoints(benchmark::State& state) {
  const FaceRows faces = RandomRows(state.range(0), 34000), points = RandomRows(state.range(0), 600);
  std::vector<int> train(size_t(state.range(0))), region(34000 / 3);
  std::iota(train.begin(), train.end(), 0);
  std::iota(region.begin(), region.end(), 0);
  const std::vector<int> validation(train.end() - 100, train.end());
  const SketchSamples samples{[&](int face) { return RowSpan(faces, size_t(face)); },
                              [&](int face) {
                                const std::span<const float> row = RowSpan(points, size_t(face));
                                return std::vector<float>(row.begin(), row.end());
                              }};
  for (auto _ : state) benchmark::DoNotOptimize(FitRidge(samples, train, validation, region, DefaultRidgeLambdas()));
}

void ProductByBlas(benchmark::State& state) {
  const FaceRows faces = RandomRows(1000, 34000), directions = RandomRows(144, 34000);
  for (auto _ : state) benchmark::DoNotOptimize(Product(directions, faces.transpose()));
}

void ProductByEigen(benchmark::State& state) {
  const FaceRows faces = RandomRows(1000, 34000), directions = RandomRows(144, 34000);
  for (auto _ : state) benchmark::DoNotOptimize(FaceRows(directions * faces.transpose()));
}

BENCHMARK(PrincipalComponentsOfFaces)->Arg(2000)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(RidgeOnCurvePoints)->Arg(2000)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(ProductByBlas)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(ProductByEigen)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace daumier::eval
