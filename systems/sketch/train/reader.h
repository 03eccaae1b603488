#pragma once
#include "eval/face_rows.h"
#include "systems/sketch/train/run_data.h"

#include <optional>
#include <span>
#include <utility>

namespace daumier::sketch {

/// What a network says of some sketches, a row a face.
struct SketchAnswers {
  eval::FaceRows u, v;
  eval::FaceRows faces;  ///< 3V, cm.
};

/// What the networks of runs make of the sketches of a database: the same augmented sketch of a face for all of them.
class SketchReader {
 public:
  /// `variation` and `seed` tell which sketch of a face is seen, as datasets::VariedSketch does. The database has to
  /// outlive it.
  SketchReader(const datasets::SketchDatabase& sketches, const datasets::SketchVariation& variation, uint64_t seed)
      : sketches_(sketches), variation_(variation), seed_(seed) {}

  datasets::AugmentedSketch Seen(int face) const;
  /// shape: the shape-level numbers, a row a face, of a network that reads them. @throws Error if such a network gets
  /// none.
  SketchAnswers Ask(SketchNetwork network, std::span<const int> faces, const eval::FaceRows* shape = nullptr) const;
  /// The faces of Ask.
  eval::FaceRows Predict(SketchNetwork network, std::span<const int> faces, const eval::FaceRows* shape = nullptr) const {
    return Ask(std::move(network), faces, shape).faces;
  }

 private:
  const datasets::SketchDatabase& sketches_;
  const datasets::SketchVariation variation_;
  const uint64_t seed_;
};

}  // namespace daumier::sketch
