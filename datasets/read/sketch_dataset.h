#pragma once
#include "datasets/read/sketch_database.h"

#include <torch/types.h>

#include <span>
#include <vector>

namespace daumier::datasets {

/// images: (B, 1, R, R) float32, ink = 1, paper = 0; faces: (B) int64, indices of the face database.
struct SketchBatch {
  torch::Tensor images, faces;
};

/// The sketches of some faces as pictures of R x R pixels: drawn once, by all cores, and kept as bytes.
class SketchDataset {
 public:
  /// Sample s is the sketch of face `faces[s]`. @throws Error if a face has no sketch.
  SketchDataset(const SketchDatabase& sketches, std::vector<int> faces, int resolution);

  int size() const { return static_cast<int>(faces_.size()); }
  const std::vector<int>& faces() const { return faces_; }

  /// @throws Error if a sample is not one of 0..size()-1.
  SketchBatch Get(std::span<const int> samples) const;

 private:
  std::vector<int> faces_;
  torch::Tensor ink_;  ///< (N, 1, R, R) uint8, ink = 255.
};

}  // namespace daumier::datasets
