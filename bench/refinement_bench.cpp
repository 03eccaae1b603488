// Operations of refinement on the mean face of ICT-FaceKit (weights/face-ict), on one core: with the whole mesh as the
// region, and with a cheek. Rival: handles pinned, the region factorised again for each set of handles.
#include "tests/support/refinement_subject.h"

#include <benchmark/benchmark.h>

#include <fmt/core.h>

#include <algorithm>
#include <string>

namespace daumier::sketch {
namespace {

using testing::RefinementSubject;

constexpr View kFront{}, kRight{-90, 0};

struct RefinementCase {
  RefinementSubject subject;
  Refinement refinement{subject.face_template};
  render::Camera front = subject.Camera(kFront), right = subject.Camera(kRight);
  geometry::SurfaceStiffness stiffness =
      geometry::MakeSurfaceStiffness({subject.face_template.neutral, subject.face_template.triangles});
  RefinementState whole = refinement.Begin(subject.face_template.neutral);
  CanvasPoints loop = RefinementSubject::Loop(subject.Cheek(kFront), 60, 75);
  RefinementState cheek = refinement.Region(whole, front, loop);
  CanvasPoints dab = {subject.Cheek(kFront)}, line = {dab[0], dab[0] + Eigen::Vector2d(0, -8)};
  geometry::TriangleMesh Mesh() const { return {whole.vertices, subject.face_template.triangles}; }

  CanvasPoints jaw = RefinementSubject::Swollen(subject.Landmarks(5, 11, kFront), {0, 12});
  CanvasPoints nose = RefinementSubject::Swollen(subject.Profile(3, -1.5, kRight), {10, 0});
};

const RefinementCase& TheCase() {
  static const RefinementCase the_case;
  return the_case;
}

void SetUp(benchmark::State& state) {
  const faces::FaceTemplate& face_template = TheCase().subject.face_template;
  for (auto _ : state) benchmark::DoNotOptimize(Refinement(face_template));
}
BENCHMARK(SetUp)->Name("set-up, whole mesh factorised")->Unit(benchmark::kMillisecond);

void RegionOfCheek(benchmark::State& state) {
  const RefinementCase& c = TheCase();
  for (auto _ : state) benchmark::DoNotOptimize(c.refinement.Region(c.whole, c.front, c.loop));
  state.counters["vertices"] = double(c.cheek.region->deformation.region().size());
}
BENCHMARK(RegionOfCheek)->Name("region of a cheek, factorised")->Unit(benchmark::kMillisecond);

/// `work` on a state with handles of a brush of this many pixels.
template <class Work>
void Register(const char* name, const Work& work) {
  for (const bool is_whole : {true, false}) {
    for (const double radius : {15.0, 30.0, 60.0}) {
      const std::string full = fmt::format("{}/{}/brush {:g}", name, is_whole ? "whole mesh" : "cheek", radius);
      benchmark::RegisterBenchmark(full.c_str(), [=](benchmark::State& state) {
        const RefinementCase& c = TheCase();
        const RefinementState& region = is_whole ? c.whole : c.cheek;
        const RefinementState brushed = c.refinement.Brush(region, c.front, c.dab, radius);
        for (auto _ : state) benchmark::DoNotOptimize(work(c, brushed));
        state.counters["handles"] = double(brushed.handles.size());
      })->Unit(benchmark::kMillisecond);
    }
  }
}

void RegisterAll() {
  Register("brush", [](const RefinementCase& c, const RefinementState& state) {
    return c.refinement.Brush(state, c.front, c.line, 30);
  });
  Register("first translation of these handles", [](const RefinementCase&, const RefinementState& state) {
    return HandleInfluence(state.region, state.handles).shares();
  });
  Register("translate", [](const RefinementCase& c, const RefinementState& state) {
    return c.refinement.Translate(state, c.front, c.line);
  });
  Register("roll",
           [](const RefinementCase& c, const RefinementState& state) { return c.refinement.Roll(state, c.front, 2); });
  Register("rival: factorised with handles", [](const RefinementCase& c, const RefinementState& state) {
    std::vector<int> free;
    std::ranges::set_difference(state.region->deformation.region(), state.handles, std::back_inserter(free));
    return geometry::RegionDeformation(c.stiffness, free, 2);
  });
  benchmark::RegisterBenchmark("visible surface", [](benchmark::State& state) {
    const RefinementCase& c = TheCase();
    for (auto _ : state) benchmark::DoNotOptimize(VisibleSurface(c.Mesh(), c.front));
  })->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark("visible silhouettes", [](benchmark::State& state) {
    const RefinementCase& c = TheCase();
    const VisibleSurface surface(c.Mesh(), c.front);
    for (auto _ : state) benchmark::DoNotOptimize(VisibleSilhouettes(c.Mesh(), c.front, surface));
  })->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark("pull chin/whole mesh", [](benchmark::State& state) {
    const RefinementCase& c = TheCase();
    for (auto _ : state) benchmark::DoNotOptimize(c.refinement.PullSilhouette(c.whole, c.front, c.jaw));
  })->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark("pull nose in profile/whole mesh", [](benchmark::State& state) {
    const RefinementCase& c = TheCase();
    for (auto _ : state) benchmark::DoNotOptimize(c.refinement.PullSilhouette(c.whole, c.right, c.nose));
  })->Unit(benchmark::kMillisecond);
}

const bool kRegistered = (RegisterAll(), true);

}  // namespace
}  // namespace daumier::sketch
