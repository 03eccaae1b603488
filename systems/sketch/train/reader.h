#pragma once
#include "eval/face_rows.h"
#include "systems/sketch/train/run_data.h"

#include <span>

namespace daumier::sketch {

/// What a network predicts of some sketches, one row a face.
struct SketchPredictions {
  eval::FaceRows u, v;
  eval::FaceRows faces;  ///< 3V, cm.
};

/// Faces that are predicted at once.
inline constexpr size_t kBlock = 64;

/// Runs networks on the sketches of a database: each network reads the same augmented sketch of a face.
class SketchReader {
 public:
  /// `variation` and `seed` determine the sketch of a face, as in datasets::VariedSketch. The database has to outlive
  /// it.
  SketchReader(const datasets::SketchDatabase& sketches, const datasets::SketchVariation& variation, uint64_t seed)
      : sketches_(sketches), variation_(variation), seed_(seed) {}

  datasets::AugmentedSketch SketchOf(int face) const;
  /// shape: the curve coefficients, one row a face, of a network that reads them. @throws Error if such a network gets
  /// none.
  FaceCoefficients Forward(SketchNetwork network, std::span<const int> faces,
                           const eval::FaceRows* shape = nullptr) const;

 private:
  const datasets::SketchDatabase& sketches_;
  const datasets::SketchVariation variation_;
  const uint64_t seed_;
};

/// Coefficients that a network predicted of a list of faces: kept for all of them, decoded when they are needed.
class StoredCoefficients {
 public:
  explicit StoredCoefficients(SketchNetwork network) : network_(std::move(network)) {}

  /// Appends a block. @throws c10::Error if the shapes disagree with the blocks before.
  void Append(const FaceCoefficients& block);
  int64_t size() const { return coefficients_.u.defined() ? coefficients_.u.size(0) : 0; }

  SketchPredictions Decode(int64_t begin, int64_t count) const;
  /// Of any entries.
  SketchPredictions Decode(std::span<const int64_t> entries) const;

 private:
  SketchPredictions Decode(const FaceCoefficients& coefficients) const;

  SketchNetwork network_;
  FaceCoefficients coefficients_;
};

}  // namespace daumier::sketch
