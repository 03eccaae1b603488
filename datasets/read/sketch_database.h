#pragma once
#include "core/manifest.h"
#include "core/safetensors.h"
#include "render/strokes.h"

#include <filesystem>
#include <vector>

namespace daumier::datasets {

/// A folder of sketches on disk, one a face of a FaceDatabase and in its order: manifest.json (kind "sketches",
/// details.faces_data_hash), shards/person-00000.safetensors with `points` (P, 2) float32 on the 256 canvas,
/// `stroke_offsets` (S + 1) int64 into points, `stroke_kinds` (S) int32, `face_offsets` (N + 1) int64 into strokes.
/// Strokes are the master; rasters are derived. Stroke k of any face samples the same curve of the template, with the
/// same number of points.
class SketchDatabase {
 public:
  explicit SketchDatabase(const std::filesystem::path& directory, bool verify = true);

  int num_faces() const { return num_faces_; }
  std::vector<render::Stroke> strokes(int face) const;
  /// All points of all strokes of a face, one after the other: 2K numbers on the 256 canvas (x0 y0 x1 ...).
  std::vector<float> curve_points(int face) const;
  const Manifest& manifest() const { return manifest_; }

 private:
  Manifest manifest_;
  int num_faces_ = 0, faces_per_shard_ = 0;
  std::vector<SafetensorsFile> shards_;
};

}  // namespace daumier::datasets
