// The 52 expressions of one face: all that a new face costs, factorisation, transfer and contact of lids and lips
// included. For the row of the paper: 46 expressions in 1.84 s [Pan et al. 2024, table 4], on another machine and mesh.
// Counters: expressions, vertices, and those that no expression moves.
#include "faces/source.h"
#include "rig/expression_targets.h"

#include <benchmark/benchmark.h>

#include <cstdlib>

namespace {

using namespace daumier;

struct Subject {
  faces::FaceModel model;
  rig::ExpressionTargets expressions;
  geometry::Points face;
};

const Subject& TheSubject() {
  static const Subject subject = [] {
    const char* const ict = std::getenv("DAUMIER_ICT");
    faces::FaceModel model = faces::LoadFaceModel(ict != nullptr ? faces::SourceOptions{.name = "ict", .path = ict}
                                                                 : faces::SourceOptions{});
    Rng rng = Stream(1, "bench");
    geometry::Points face = faces::IdentityFace(model, faces::DrawIdentity(model, rng));
    rig::ExpressionTargets expressions(model);
    return Subject{std::move(model), std::move(expressions), std::move(face)};
  }();
  return subject;
}

void Targets(benchmark::State& state) {
  const Subject& subject = TheSubject();
  rig::MorphTargets targets;
  for (auto _ : state) {
    targets = subject.expressions.On(subject.face, static_cast<unsigned>(state.range(0)));
    benchmark::DoNotOptimize(targets.offsets.data());
  }
  int num_pinned = 0, num_made = 0;
  for (Eigen::Index v = 0; v < subject.face.rows(); ++v) num_pinned += targets.offsets.middleRows(3 * v, 3).isZero(0);
  for (Eigen::Index e = 0; e < targets.offsets.cols(); ++e) num_made += !targets.offsets.col(e).isZero(0);
  state.counters["expressions"] = num_made;
  state.counters["vertices"] = double(subject.face.rows());
  state.counters["pinned"] = num_pinned;
}
BENCHMARK(Targets)->Arg(1)->Arg(2)->ArgName("threads")->Unit(benchmark::kMillisecond)->UseRealTime();

/// The contact alone.
void Contact(benchmark::State& state) {
  const Subject& subject = TheSubject();
  const rig::MorphTargets made = subject.expressions.On(subject.face);
  for (auto _ : state) {
    rig::MorphTargets targets = made;
    subject.expressions.contact().Apply(subject.face, targets, static_cast<unsigned>(state.range(0)));
    benchmark::DoNotOptimize(targets.offsets.data());
  }
}
BENCHMARK(Contact)->Arg(1)->Arg(2)->ArgName("threads")->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
