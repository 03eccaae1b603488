#pragma once
#include "core/sample_batch.h"
#include "datasets/read/sketch_variation.h"
#include "faces/curve_encoder.h"

#include <cstdint>
#include <span>
#include <vector>

namespace daumier::datasets {

/// What is read of a sketch; a network needs one or two of the three.
struct SketchReading {
  int resolution = 0;  ///< R of its picture; 0: none.
  int num_points = 0;  ///< P sampled along its strokes (render::SampleStrokes); 0: none.
  /// Gives the shape-level numbers of its labelled strokes (GivenShape), as augmented; null: none. Has to outlive the
  /// dataset.
  const faces::CurveEncoder* encoder = nullptr;
  bool fixed = false;  ///< Every epoch shows what the first one does.
};

/// The sketches of some faces as input of a network, computed by all cores. Without variation they are computed once
/// and kept, pictures as bytes. With variation they are computed for each batch; a sample is a function of variation,
/// seed, face and epoch alone.
class SketchDataset {
 public:
  /// Sample s is the sketch of face `faces[s]`. @throws Error if a face has no sketch.
  SketchDataset(const SketchDatabase& sketches, std::vector<int> faces, const SketchReading& reading,
                const SketchVariation& variation = {}, uint64_t seed = 0);

  int size() const { return static_cast<int>(faces_.size()); }
  const std::vector<int>& faces() const { return faces_; }

  /// The arrays and indices that the reading selects:
  ///   images  B x 1 x R x R, ink = 1, paper = 0
  ///   points  B x 4 x P: x and y from -1 to 1 over the canvas, cosine and sine of the double angle
  ///   shape   B x (Ku + Kv), u and v of the 2-D curve model
  ///   faces   B indices of the face database, always
  /// May be called from several threads. @throws Error if a sample is not one of 0..size()-1.
  SampleBatch Get(std::span<const int> samples, int64_t epoch = 0) const;

 private:
  /// Pictures of bytes, ink = 255, and the other arrays of a batch.
  struct Rows {
    Array<uint8_t> ink;
    FloatArray points, shape;
  };
  Rows EmptyRows(int64_t count) const;
  void Read(int face, int64_t epoch, int64_t row, Rows& rows) const;

  std::vector<int> faces_;
  SketchReading reading_;
  SketchVariation variation_;
  uint64_t seed_;
  SketchDatabase sketches_;  ///< Shares the mapped files.
  Rows kept_;                ///< A row a sample.
  bool varies_;
};

}  // namespace daumier::datasets
