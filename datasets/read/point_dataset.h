#pragma once
#include "core/options.h"
#include "core/sample_batch.h"
#include "datasets/read/point_database.h"
#include "faces/face_database.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace daumier::datasets {

/// Which points of a face are read.
struct PointReading {
  int num_points = 2048;
  std::string sampling = "hybrid";

  template <class V>
  void Visit(V&& visit) {
    visit("num_points", num_points, Range{0, 1e7},
          "Number of points of each face in a step; 0: all points, in their order.");
    visit("sampling", sampling, Choices{{"hybrid", "vertices"}},
          "hybrid: vertices and surface samples, in the proportion of the database; vertices: vertices alone.");
  }
};

/// The points of some faces as input of a deformable model, computed by all cores.
class PointDataset {
 public:
  /// Sample s is face `faces[s]`. `points` are those of `database`. @throws Error if they were made of other faces, a
  /// face is not there, or the reading is none.
  PointDataset(const faces::FaceDatabase& database, const PointDatabase& points, std::vector<int> faces,
               const PointReading& reading, uint64_t seed = 0);

  int size() const { return static_cast<int>(faces_.size()); }
  const std::vector<int>& faces() const { return faces_; }

  /// num_points of each face, drawn with replacement from Stream(seed, "points of epoch E", face): what is read of a
  /// sample is a function of reading, seed, face and epoch alone. With num_points = 0 all of them, vertices first.
  /// Of N points on each of B faces:
  ///   corners    indices, B x N x 3: the vertices of the triangle in which a point lies
  ///   weights    B x N x 3, of these corners; they sum to 1. A vertex v has the corners v, v, v and the weights 1, 0,
  ///   0 positions  B x N x 3, on the template with its mouth open, model frame
  ///   targets    B x N x 3, on the face, model frame
  /// May be called from several threads. @throws Error if a sample is not one of 0..size()-1.
  SampleBatch Get(std::span<const int> samples, int64_t epoch = 0) const;

  /// All V vertices of these faces, in order. @throws Error as Get.
  SampleBatch Vertices(std::span<const int> samples) const;

 private:
  struct Row;
  /// Batches of num_points a face: read(face, row) writes those of one.
  template <class Read>
  SampleBatch Collect(std::span<const int> samples, int num_points, const Read& read) const;
  /// Point `index` of the face of a row: a vertex, or behind these a surface sample.
  void Write(const Row& row, int64_t n, int index) const;

  faces::FaceDatabase database_;  ///< Shares the mapped files, as points_ does.
  PointDatabase points_;
  std::vector<int> faces_;
  PointReading reading_;
  uint64_t seed_;
};

}  // namespace daumier::datasets
