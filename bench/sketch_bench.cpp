// Faces of ICT-FaceKit (or of the default source, where DAUMIER_ICT names no checkout or archive of it) to sketches:
// curves alone, with wrinkles, what a kept sketch costs in training (augmentation, raster), and a step of the network
// compared with drawing its batch.
#include "datasets/build/sketch_lines.h"
#include "datasets/build/sketch_views.h"
#include "datasets/read/augmentation.h"
#include "faces/expression_transfer.h"
#include "faces/source.h"
#include "losses/vertex_loss.h"
#include "systems/sketch/train/network.h"
#include "tensor/runtime.h"
#include "tests/support/random_bilinear.h"

#include <benchmark/benchmark.h>
#include <torch/optim.h>
#include <torch/utils.h>

#include <cstdlib>

namespace daumier {
namespace {

constexpr int kFaces = 16, kBatch = 32, kResolution = 128;

struct Subject {
  faces::FaceModel model;
  std::vector<geometry::Points> faces;
};

/// Random persons, each with another expression.
const Subject& TheSubject() {
  static const Subject subject = [] {
    const char* const ict = std::getenv("DAUMIER_ICT");
    Subject result{faces::LoadFaceModel(ict != nullptr ? faces::SourceOptions{.name = "ict", .path = ict}
                                                       : faces::SourceOptions{}),
                   {}};
    const faces::ExpressionTransfer transfer(result.model, result.model.expressions);
    Rng rng = Stream(1, "bench");
    for (int i = 0; i < kFaces; ++i) {
      geometry::Points face = IdentityFace(result.model, DrawIdentity(result.model, rng));
      const Eigen::MatrixXf offsets = transfer.Offsets(face);
      const Eigen::VectorXf offset = offsets.col(i % offsets.cols());
      for (Eigen::Index v = 0; v < face.rows(); ++v) face.row(v) += offset.segment<3>(3 * v).cast<double>().transpose();
      result.faces.push_back(face);
    }
    return result;
  }();
  return subject;
}

std::vector<std::vector<render::Stroke>> Sketches(bool wrinkles) {
  const faces::FaceTemplate& face_template = TheSubject().model.face_template;
  const datasets::SketchLines lines(face_template, faces::View::kFrontal, {.drawn = wrinkles});
  const render::Camera camera = datasets::SketchCamera(face_template, faces::View::kFrontal, 0.62);
  std::vector<std::vector<render::Stroke>> sketches;
  for (const auto& face : TheSubject().faces) sketches.push_back(lines.Draw(face, camera));
  return sketches;
}

/// One core: a build draws on all of them.
void DrawLines(benchmark::State& state) {
  const faces::FaceTemplate& face_template = TheSubject().model.face_template;
  const datasets::SketchLines lines(face_template, faces::View::kFrontal, {.drawn = state.range(0) != 0});
  const render::Camera camera = datasets::SketchCamera(face_template, faces::View::kFrontal, 0.62);
  int face = 0;
  for (auto _ : state) benchmark::DoNotOptimize(lines.Draw(TheSubject().faces[size_t(face++ % kFaces)], camera).size());
  state.counters["sketches"] = benchmark::Counter(1, benchmark::Counter::kIsIterationInvariantRate);
  state.counters["vertices"] = face_template.num_vertices();
}
BENCHMARK(DrawLines)->ArgName("wrinkles")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

datasets::AugmentationOptions Augmented() {
  datasets::AugmentationOptions options;
  options.strength = 1;
  return options;
}

void Augmentation(benchmark::State& state) {
  const auto sketches = Sketches(true);
  Rng rng(1);
  int face = 0;
  for (auto _ : state)
    benchmark::DoNotOptimize(datasets::Augment(sketches[size_t(face++ % kFaces)], Augmented(), rng).strokes.data());
}
BENCHMARK(Augmentation)->Unit(benchmark::kMicrosecond);

void Rasterisation(benchmark::State& state) {
  const auto sketches = Sketches(true);
  int face = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(render::RasteriseStrokes(sketches[size_t(face++ % kFaces)], kResolution).pixels.data());
  }
}
BENCHMARK(Rasterisation)->Unit(benchmark::kMicrosecond);

/// A step of the default network on stored sketches, and on sketches that are augmented and drawn before it, on one
/// core.
void TrainingStep(benchmark::State& state) {
  tensor::SetUpTorch(1);
  torch::manual_seed(1);
  constexpr int kNumVertices = 4284;
  const sketch::FittedModels models{
      testing::RandomBilinear(kNumVertices, 50, 16, 1), testing::RandomBilinear(200, 50, 16, 2), {}};
  sketch::SketchNetwork network(sketch::SketchNetworkOptions(), models);
  const losses::GramVertexLoss loss(network->basis(), torch::ones({kNumVertices}));
  const auto moments = loss.Moments(torch::randn({kBatch, 3 * kNumVertices}));
  torch::optim::Adam adam(network->parameters());
  const auto sketches = Sketches(true);
  Rng rng(1);
  torch::Tensor images = torch::zeros({kBatch, 1, kResolution, kResolution});
  const auto draw = [&] {
    float* ink = images.data_ptr<float>();
    for (int sample = 0; sample < kBatch; ++sample) {
      const auto augmented = datasets::Augment(sketches[size_t(sample % kFaces)], Augmented(), rng);
      for (const uint8_t grey : render::RasteriseStrokes(augmented.strokes, kResolution, augmented.style).pixels)
        *ink++ = static_cast<float>(255 - grey) / 255.0f;
    }
  };
  draw();
  for (auto _ : state) {
    if (state.range(0) != 0) draw();
    adam.zero_grad();
    loss(network->Linear(network->forward({images, {}, {}})), moments).backward();
    adam.step();
  }
  state.counters["sketches"] = benchmark::Counter(kBatch, benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(TrainingStep)->ArgName("augmented")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace daumier
