#pragma once
#include "datasets/read/sketch_variation.h"
#include "faces/curve_encoder.h"

#include <torch/types.h>

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

/// What the reading asks for; the rest is undefined. faces: (B) int64, indices of the face database.
struct SketchBatch {
  /// (B, 1, R, R) float32, ink = 1, paper = 0; told to have channels last, which of one channel is the same memory, for
  /// convolutions hand on the layout that they are given, and are faster in this one.
  torch::Tensor images;
  torch::Tensor
      points;  ///< (B, 4, P) float32: x and y from -1 to 1 over the canvas, cosine and sine of the double angle.
  torch::Tensor shape;  ///< (B, Ku + Kv) float32, u and v of the 2-D model.
  torch::Tensor faces;
};

/// The sketches of some faces as a network reads them, worked out by all cores. Where they do not vary this is done
/// once and kept, pictures as bytes, and every epoch shows the same; else anew for each batch, and what is read of a
/// sample is a function of variation, seed, face and epoch alone.
class SketchDataset {
 public:
  /// Sample s is the sketch of face `faces[s]`. @throws Error if a face has no sketch.
  SketchDataset(const SketchDatabase& sketches, std::vector<int> faces, const SketchReading& reading,
                const SketchVariation& variation = {}, uint64_t seed = 0);

  int size() const { return static_cast<int>(faces_.size()); }
  const std::vector<int>& faces() const { return faces_; }

  /// @throws Error if a sample is not one of 0..size()-1.
  SketchBatch Get(std::span<const int> samples, int64_t epoch = 0) const;

 private:
  /// Rows of tensors as SketchBatch has them, but pictures of bytes, ink = 255.
  struct Rows {
    torch::Tensor ink, points, shape;
  };
  Rows EmptyRows(int64_t count) const;
  void Read(int face, int64_t epoch, int64_t row, const Rows& rows) const;

  std::vector<int> faces_;
  SketchReading reading_;
  SketchVariation variation_;
  uint64_t seed_;
  SketchDatabase sketches_;  ///< Shares the mapped files.
  Rows kept_;                ///< A row a sample.
  bool varies_;
};

}  // namespace daumier::datasets
