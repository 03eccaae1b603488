#include "datasets/read/point_dataset.h"

#include "core/error.h"
#include "core/parallel.h"
#include "core/random.h"

#include <array>

namespace daumier::datasets {

/// What is read and written for one face of a batch.
struct PointDataset::Row {
  std::span<const float> vertices;  ///< Of the face, cm.
  SurfaceSamples samples;
  int64_t* corners;
  float *weights, *positions, *targets;
};

PointDataset::PointDataset(const faces::FaceDatabase& database, const PointDatabase& points, std::vector<int> faces,
                           const PointReading& reading, uint64_t seed)
    : database_(database), points_(points), faces_(std::move(faces)), reading_(reading), seed_(seed) {
  DAUMIER_CHECK(points.manifest().details.value("faces_data_hash", "") == DataHash(database.directory()),
                "the points were not made of the faces in {}; rebuild them with: daumier dataset points",
                database.directory().string());
  DAUMIER_CHECK(reading.num_points >= 0 && (reading.sampling == "hybrid" || reading.sampling == "vertices"),
                "{} points a face of the sampling {}", reading.num_points, reading.sampling);
  for (const int face : faces_)
    DAUMIER_CHECK(face >= 0 && face < points.num_faces(), "points of face {} of a database of {}", face,
                  points.num_faces());
}

void PointDataset::Write(const Row& row, int64_t n, int index) const {
  std::array<int64_t, 3> corners{index, index, index};
  std::array<float, 3> weights{1, 0, 0};
  if (index >= points_.num_vertices()) {
    const size_t s = size_t(index - points_.num_vertices());
    const int* const triangle = points_.face_template().triangles.data() + 3 * int64_t(row.samples.triangles[s]);
    const float w0 = row.samples.weights[2 * s], w1 = row.samples.weights[2 * s + 1];
    corners = {triangle[0], triangle[1], triangle[2]};
    weights = {w0, w1, 1 - w0 - w1};
  }
  const std::span<const float> open = points_.template_vertices();
  const auto scale = static_cast<float>(points_.frame().scale);
  for (int k = 0; k < 3; ++k) {
    const auto mixed = [&](std::span<const float> from) {
      float sum = 0;
      for (size_t c = 0; c < 3; ++c) sum += weights[c] * from[size_t(3 * corners[c] + k)];
      return sum;
    };
    row.corners[3 * n + k] = corners[size_t(k)];
    row.weights[3 * n + k] = weights[size_t(k)];
    row.positions[3 * n + k] = mixed(open);
    row.targets[3 * n + k] = scale * mixed(row.vertices) + static_cast<float>(points_.frame().offset[k]);
  }
}

template <class Read>
SampleBatch PointDataset::Collect(std::span<const int> samples, int num_points, const Read& read) const {
  for (const int sample : samples)
    DAUMIER_CHECK(sample >= 0 && sample < size(), "sample {} of a dataset of {}", sample, size());
  const auto count = static_cast<int64_t>(samples.size());
  const std::vector<int64_t> shape{count, num_points, 3};
  SampleBatch batch{.samples = {samples.begin(), samples.end()}, .arrays = {}, .indices = {}};
  int64_t* const corners = (batch.indices["corners"] = Array<int64_t>(shape)).values.data();
  const auto floats = [&](const char* name) { return (batch.arrays[name] = FloatArray(shape)).values.data(); };
  float *const weights = floats("weights"), *const positions = floats("positions"), *const targets = floats("targets");
  OnAllCores(count, [&](int64_t i) {
    const int face = faces_[size_t(samples[size_t(i)])];
    const int64_t at = i * num_points * 3;
    read(face, Row{database_.vertices(face), points_.samples(face), corners + at, weights + at, positions + at,
                   targets + at});
  });
  return batch;
}

SampleBatch PointDataset::Get(std::span<const int> samples, int64_t epoch) const {
  const int num_there = points_.num_vertices() + (reading_.sampling == "hybrid" ? points_.num_samples() : 0);
  if (reading_.num_points == 0) {
    return Collect(samples, num_there, [&](int, const Row& row) {
      for (int n = 0; n < num_there; ++n) Write(row, n, n);
    });
  }
  return Collect(samples, reading_.num_points, [&](int face, const Row& row) {
    Rng rng = Stream(seed_, fmt::format("points of epoch {}", epoch), uint64_t(face));
    for (int n = 0; n < reading_.num_points; ++n) Write(row, n, static_cast<int>(rng.Below(uint64_t(num_there))));
  });
}

SampleBatch PointDataset::Vertices(std::span<const int> samples) const {
  const int num_vertices = points_.num_vertices();
  return Collect(samples, num_vertices, [&](int, const Row& row) {
    for (int n = 0; n < num_vertices; ++n) Write(row, n, n);
  });
}

}  // namespace daumier::datasets
