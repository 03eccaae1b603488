// The expressions of ICT-FaceKit (or of the default source, where DAUMIER_ICT names no checkout or archive of it)
// carried to one face: all that a new face costs, factorisation included, compared with the linear shapes that it
// replaces.
#include "faces/expression_transfer.h"
#include "faces/source.h"

#include <benchmark/benchmark.h>

#include <cstdlib>

namespace {

using namespace daumier::faces;

struct Subject {
  FaceModel model;
  std::vector<Expression> shapes;  ///< One an expression shape.
  daumier::geometry::Points face;
};

const Subject& TheSubject() {
  static const Subject subject = [] {
    const char* const ict = std::getenv("DAUMIER_ICT");
    Subject result{LoadFaceModel(ict != nullptr ? SourceOptions{.name = "ict", .path = ict} : SourceOptions{}), {}, {}};
    for (Eigen::Index e = 0; e < result.model.expression_shapes.cols(); ++e) {
      result.shapes.push_back(
          {result.model.expression_shape_names[e], Eigen::VectorXf::Unit(result.model.expression_shapes.cols(), e)});
    }
    daumier::Rng rng = daumier::Stream(1, "bench");
    result.face = IdentityFace(result.model, DrawIdentity(result.model, rng));
    return result;
  }();
  return subject;
}

void Transfer(benchmark::State& state) {
  const Subject& subject = TheSubject();
  const ExpressionTransfer transfer(subject.model, subject.shapes);
  for (auto _ : state)
    benchmark::DoNotOptimize(transfer.Offsets(subject.face, static_cast<unsigned>(state.range(0))).sum());
  state.counters["expressions"] = double(subject.shapes.size());
  state.counters["vertices"] = subject.model.face_template.num_vertices();
}
BENCHMARK(Transfer)->Arg(1)->Arg(2)->ArgName("threads")->Unit(benchmark::kMillisecond)->UseRealTime();

void LinearShapes(benchmark::State& state) {
  const Subject& subject = TheSubject();
  for (auto _ : state) {
    for (const Expression& shape : subject.shapes)
      benchmark::DoNotOptimize(ExpressionOffset(subject.model, shape.weights).sum());
  }
}
BENCHMARK(LinearShapes)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
