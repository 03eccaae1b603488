#pragma once
#include "datasets/read/sketch_variation.h"

#include <torch/types.h>

#include <cstdint>
#include <span>
#include <vector>

namespace daumier::datasets {

/// images: (B, 1, R, R) float32, ink = 1, paper = 0; faces: (B) int64, indices of the face database.
struct SketchBatch {
  torch::Tensor images, faces;
};

/// The sketches of some faces as pictures of R x R pixels, drawn by all cores. Where they do not vary they are drawn
/// once and kept as bytes, and are the same in every epoch; else they are drawn anew for each batch, and the picture of
/// a sample is a function of variation, seed, face and epoch alone.
class SketchDataset {
 public:
  /// Sample s is the sketch of face `faces[s]`. @throws Error if a face has no sketch.
  SketchDataset(const SketchDatabase& sketches, std::vector<int> faces, int resolution,
                const SketchVariation& variation = {}, uint64_t seed = 0);

  int size() const { return static_cast<int>(faces_.size()); }
  const std::vector<int>& faces() const { return faces_; }

  /// @throws Error if a sample is not one of 0..size()-1.
  SketchBatch Get(std::span<const int> samples, int64_t epoch = 0) const;

 private:
  render::Image Draw(int face, int64_t epoch) const;

  std::vector<int> faces_;
  int resolution_;
  SketchVariation variation_;
  uint64_t seed_;
  SketchDatabase sketches_;  ///< Shares the mapped files.
  torch::Tensor ink_;        ///< (N, 1, R, R) uint8, ink = 255; undefined if sketches vary.
};

}  // namespace daumier::datasets
