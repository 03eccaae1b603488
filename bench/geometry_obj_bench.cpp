// Our OBJ reader of whole meshes and of vertices alone, on a quad sphere of the size of an ICT-FaceKit mesh (26,719
// vertices) that is written first.
#include "core/files.h"
#include "geometry/obj.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <numbers>

namespace {

constexpr int kColumns = 162, kRows = 165;

const std::string& MeshFile() {
  static const std::string file = [] {
    std::string text;
    for (int row = 0; row < kRows; ++row) {
      for (int column = 0; column < kColumns; ++column) {
        const double theta = std::numbers::pi * (row + 0.5) / kRows, phi = 2 * std::numbers::pi * column / kColumns;
        text += fmt::format("v {:.6f} {:.6f} {:.6f}\n", std::sin(theta) * std::cos(phi), std::cos(theta),
                            std::sin(theta) * std::sin(phi));
      }
    }
    for (int row = 0; row + 1 < kRows; ++row) {
      for (int column = 0; column < kColumns; ++column) {
        const int next = (column + 1) % kColumns, a = row * kColumns + 1, b = a + kColumns;
        text += fmt::format("f {} {} {} {}\n", a + column, b + column, b + next, a + next);
      }
    }
    const std::filesystem::path path = std::filesystem::temp_directory_path() / "daumier_bench.obj";
    daumier::WriteFileAtomically(path, text);
    return path.string();
  }();
  return file;
}

void OurReader(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(daumier::geometry::ReadObj(MeshFile()).vertices.sum());
}
BENCHMARK(OurReader)->Unit(benchmark::kMillisecond);

void OurReaderOfVerticesAlone(benchmark::State& state) {
  for (auto _ : state) {
    const daumier::MappedFile file(MeshFile());
    benchmark::DoNotOptimize(daumier::geometry::ParseObjVertices(file.bytes(), MeshFile(), kColumns * kRows).sum());
  }
}
BENCHMARK(OurReaderOfVerticesAlone)->Unit(benchmark::kMillisecond);

}  // namespace
