// Fitting the bilinear model through Gram matrices, compared with the SVD of the unfoldings, and projecting a face.
#include "core/random.h"
#include "faces/bilinear_projector.h"

#include <benchmark/benchmark.h>
#include <Eigen/SVD>

namespace daumier::faces {
namespace {

/// Column i * E + e is a face of 3V coordinates: a mean, an identity, an expression and noise.
Eigen::MatrixXf RandomFaces(int num_identities, int num_expressions, int num_coordinates) {
  Rng rng(1);
  const auto random = [&rng](int rows, int columns, float size) {
    return Eigen::MatrixXf(
        Eigen::MatrixXf::NullaryExpr(rows, columns, [&] { return size * static_cast<float>(rng.Uniform(-1, 1)); }));
  };
  const Eigen::VectorXf mean = random(num_coordinates, 1, 10);
  const Eigen::MatrixXf identities = random(num_coordinates, num_identities, 1);
  const Eigen::MatrixXf expressions = random(num_coordinates, num_expressions, 1);
  Eigen::MatrixXf faces(num_coordinates, num_identities * num_expressions);
  for (int column = 0; column < faces.cols(); ++column) {
    const int i = column / num_expressions, e = column % num_expressions;
    faces.col(column) =
        mean + identities.col(i) + expressions.col(e) + 0.1f * identities.col(i).cwiseProduct(expressions.col(e));
  }
  return faces;
}

constexpr int kExpressions = 25;

BilinearModel Fit(const Eigen::MatrixXf& faces, int num_identities, const BilinearOptions& options) {
  return FitBilinear(
      num_identities, kExpressions, static_cast<int>(faces.rows()),
      [&](int i, int e) {
        return std::span<const float>(faces.col(i * kExpressions + e).data(), static_cast<size_t>(faces.rows()));
      },
      options);
}

/// Arguments: identities, coordinates.
void GramMatrices(benchmark::State& state) {
  const int num_identities = static_cast<int>(state.range(0));
  const Eigen::MatrixXf faces = RandomFaces(num_identities, kExpressions, static_cast<int>(state.range(1)));
  for (auto _ : state) benchmark::DoNotOptimize(Fit(faces, num_identities, {}).core.data());
  state.counters["faces/s"] = benchmark::Counter(double(faces.cols()), benchmark::Counter::kIsIterationInvariantRate);
}

/// The identity factors alone, as a textbook has it.
void SvdOfTheUnfolding(benchmark::State& state) {
  const int num_identities = static_cast<int>(state.range(0));
  const Eigen::MatrixXf faces = RandomFaces(num_identities, kExpressions, static_cast<int>(state.range(1)));
  const Eigen::Map<const Eigen::MatrixXf> unfolding(faces.data(), faces.rows() * kExpressions, num_identities);
  for (auto _ : state) benchmark::DoNotOptimize(unfolding.bdcSvd(Eigen::ComputeThinV).matrixV().eval().data());
}

void Project(benchmark::State& state) {
  const Eigen::MatrixXf faces = RandomFaces(72, kExpressions, static_cast<int>(state.range(0)));
  const BilinearModel model = Fit(faces, 72, {});
  const BilinearProjector projector(model);
  for (auto _ : state) {
    benchmark::DoNotOptimize(projector.Project({faces.col(100).data(), static_cast<size_t>(faces.rows())}).u.data());
  }
}

void MakeProjector(benchmark::State& state) {
  const Eigen::MatrixXf faces = RandomFaces(72, kExpressions, static_cast<int>(state.range(0)));
  const BilinearModel model = Fit(faces, 72, {});
  for (auto _ : state) benchmark::DoNotOptimize(BilinearProjector(model));
}

BENCHMARK(GramMatrices)->Args({60, 1500})->Args({72, 12000})->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(SvdOfTheUnfolding)->Args({60, 1500})->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(Project)->Arg(12000)->Unit(benchmark::kMillisecond);
BENCHMARK(MakeProjector)->Arg(12000)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace daumier::faces
