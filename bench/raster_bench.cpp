// The differentiable renderer on a face of 22,288 triangles (ICT-FaceKit's face and head; a ball of as many without it) in
// a picture of 224 x 224, next to a plain z-buffer loop that only finds the visible triangles.
#include "raster/batch.h"
#include "raster/face_picture.h"
#include "raster/rasterise.h"
#include "tests/raster/small_mesh.h"
#include "tests/support/ict_head.h"
#include "tests/support/paths.h"

#include <benchmark/benchmark.h>

#include <cmath>
#include <limits>
#include <memory>

namespace {

using namespace daumier;
using raster::Camera;

constexpr int kSide = 224, kPixels = kSide * kSide;

struct BenchFace {
  raster::MeshTopology topology;
  std::vector<float> vertices, albedo, positions, colours;
  raster::Pose<float> pose = {0.05f, 0.1f, 0.02f, 0.1f, -0.2f, -20.0f};
  std::array<float, raster::kLightBands> light = {0.1f, -0.2f, 0.3f, 0.15f, 0.05f, -0.1f, 0.08f, 0.04f, 0.06f};
};

const BenchFace& Face() {
  static const BenchFace face = [] {
    BenchFace made;
    const auto shared = testing::SharedData();
    if (shared && std::filesystem::exists(*shared / "ict-facekit.tar.xz")) {
      geometry::TriangleMesh mesh = testing::LoadIctHead(*shared / "ict-facekit.tar.xz", {}).neutral;
      const Eigen::RowVector3d middle = (mesh.vertices.colwise().minCoeff() + mesh.vertices.colwise().maxCoeff()) / 2;
      mesh.vertices.rowwise() -= middle;
      made.topology =
          raster::MakeTopology({mesh.triangles.data(), size_t(mesh.triangles.size())}, int(mesh.vertices.rows()));
      made.vertices.assign(mesh.vertices.data(), mesh.vertices.data() + mesh.vertices.size());
    } else {
      const Camera flat = {.projection = Camera::Projection::kOrthographic, .focal = 1, .centre_x = 0, .centre_y = 0};
      const auto ball = raster::BumpyBall<float>(75, 10, flat);
      made.topology = ball.topology;
      for (size_t i = 0; i < ball.positions.size(); i += 4) {
        made.vertices.insert(made.vertices.end(), {ball.positions[i], -ball.positions[i + 1], -ball.positions[i + 2]});
      }
    }
    made.albedo = raster::RandomNumbers<float>(made.vertices.size(), 1);
    for (float& number : made.albedo) number = 0.6f + 0.1f * number;
    made.colours = made.albedo;
    std::vector<float> posed(made.vertices.size());
    made.positions.resize(made.vertices.size() / 3 * 4);
    raster::ApplyPose(made.pose, int64_t(made.vertices.size() / 3), made.vertices.data(), posed.data());
    raster::Project(Camera{}, int64_t(made.vertices.size() / 3), posed.data(), made.positions.data());
    return made;
  }();
  return face;
}

const std::vector<float>& PictureGradient() {
  static const std::vector<float> gradient = raster::RandomNumbers<float>(4 * kPixels, 9);
  return gradient;
}

void CountTriangles(benchmark::State& state) {
  state.counters["triangles"] = Face().topology.num_triangles();
}

/// Bounding boxes, barycentrics and a z-buffer, as one writes it down.
void PlainZBuffer(benchmark::State& state) {
  const BenchFace& face = Face();
  std::vector<float> depth(kPixels), x(face.topology.num_vertices), y(x), z(x);
  std::vector<int> triangle(kPixels);
  for (auto _ : state) {
    std::fill(depth.begin(), depth.end(), std::numeric_limits<float>::infinity());
    std::fill(triangle.begin(), triangle.end(), -1);
    for (size_t v = 0; v < x.size(); ++v) {
      const float* const p = &face.positions[4 * v];
      x[v] = p[0] / p[3], y[v] = p[1] / p[3], z[v] = p[2] / p[3];
    }
    for (int t = 0; t < face.topology.num_triangles(); ++t) {
      const auto [i, j, k] = face.topology.triangles[t];
      const float area = (x[j] - x[i]) * (y[k] - y[i]) - (x[k] - x[i]) * (y[j] - y[i]);
      if (area == 0) continue;
      const int left = std::max(0, int(std::floor(std::min({x[i], x[j], x[k]}))));
      const int right = std::min(kSide - 1, int(std::ceil(std::max({x[i], x[j], x[k]}))));
      const int top = std::max(0, int(std::floor(std::min({y[i], y[j], y[k]}))));
      const int bottom = std::min(kSide - 1, int(std::ceil(std::max({y[i], y[j], y[k]}))));
      for (int row = top; row <= bottom; ++row) {
        for (int column = left; column <= right; ++column) {
          const float fx = column + 0.5f, fy = row + 0.5f;
          const float b0 = ((x[j] - fx) * (y[k] - fy) - (x[k] - fx) * (y[j] - fy)) / area;
          const float b1 = ((x[k] - fx) * (y[i] - fy) - (x[i] - fx) * (y[k] - fy)) / area;
          const float b2 = 1 - b0 - b1;
          if (b0 < 0 || b1 < 0 || b2 < 0) continue;
          const float at = b0 * z[i] + b1 * z[j] + b2 * z[k];
          if (at >= depth[row * kSide + column]) continue;
          depth[row * kSide + column] = at;
          triangle[row * kSide + column] = t;
        }
      }
    }
    benchmark::DoNotOptimize(triangle.data());
  }
  CountTriangles(state);
}
BENCHMARK(PlainZBuffer)->Unit(benchmark::kMillisecond)->UseRealTime();

void VisibleTriangles(benchmark::State& state, raster::Facing facing) {
  const BenchFace& face = Face();
  raster::Raster<float> raster;
  for (auto _ : state) {
    raster::FindVisibleTriangles(face.topology, face.positions.data(), kSide, kSide, facing, raster);
    benchmark::DoNotOptimize(raster.triangle.data());
  }
}
BENCHMARK_CAPTURE(VisibleTriangles, front, raster::Facing::kFront)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(VisibleTriangles, both, raster::Facing::kBoth)->Unit(benchmark::kMillisecond)->UseRealTime();

/// Positions and colours in; rasterise, interpolate, antialias; and, with `backward`, all of the gradient.
void Colours(benchmark::State& state, raster::Facing facing, bool backward) {
  const BenchFace& face = Face();
  raster::ColourPicture<float> picture;
  std::vector<float> image(4 * kPixels), by_positions(face.positions.size()), by_colours(face.colours.size());
  for (auto _ : state) {
    picture.Forward(face.topology, face.positions.data(), face.colours.data(), kSide, kSide, {.facing = facing},
                    image.data());
    if (backward) {
      picture.Backward(face.topology, PictureGradient().data(), by_positions.data(), by_colours.data());
    }
    benchmark::DoNotOptimize(image.data());
  }
  state.counters["crossings"] = double(picture.crossings().size());
}
BENCHMARK_CAPTURE(Colours, forward, raster::Facing::kFront, false)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(Colours, forward_backward, raster::Facing::kFront, true)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(Colours, forward_backward_both_sides, raster::Facing::kBoth, true)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

/// With pose, camera, normals and shading.
void ShadedFace(benchmark::State& state) {
  const BenchFace& face = Face();
  raster::FacePicture<float> picture;
  std::vector<float> image(4 * kPixels), by_vertices(face.vertices.size()), by_albedo(face.albedo.size());
  std::array<float, raster::kLightBands> by_light;
  raster::Pose<float> by_pose;
  for (auto _ : state) {
    picture.Forward(face.topology, face.vertices.data(), face.albedo.data(), face.light, face.pose, {}, {},
                    image.data());
    picture.Backward(face.topology, face.vertices.data(), face.albedo.data(), PictureGradient().data(),
                     by_vertices.data(), by_albedo.data(), by_light, by_pose);
    benchmark::DoNotOptimize(by_pose);
  }
}
BENCHMARK(ShadedFace)->Unit(benchmark::kMillisecond)->UseRealTime();

/// 32 pictures and their gradients on a number of threads.
void BatchOf32(benchmark::State& state) {
  constexpr int kImages = 32;
  const BenchFace& face = Face();
  ThreadPool pool(int(state.range(0)) - 1);
  std::vector<raster::ColourPicture<float>> pictures(kImages);
  std::vector<std::vector<float>> images(kImages, std::vector<float>(4 * kPixels)),
      by_positions(kImages, std::vector<float>(face.positions.size())),
      by_colours(kImages, std::vector<float>(face.colours.size()));
  for (auto _ : state) {
    raster::ForEachImage(
        kImages,
        [&](int i) {
          pictures[i].Forward(face.topology, face.positions.data(), face.colours.data(), kSide, kSide, {},
                              images[i].data());
          pictures[i].Backward(face.topology, PictureGradient().data(), by_positions[i].data(), by_colours[i].data());
        },
        pool);
  }
  state.counters["images/s"] = benchmark::Counter(kImages, benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(BatchOf32)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
