#pragma once
#include "core/manifest.h"
#include "core/safetensors.h"
#include "faces/face_model.h"
#include "faces/model_frame.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace daumier::datasets {

/// Points on the surface of a face: point s is w0 p0 + w1 p1 + (1 - w0 - w1) p2, p0, p1 and p2 the corners of triangle
/// triangles[s] of the template's open surface.
struct SurfaceSamples {
  std::span<const int32_t> triangles;  ///< S
  std::span<const float> weights;      ///< S x 2: w0 and w1.
};

/// A folder of surface points on disk, of each face of a FaceDatabase and in its order: manifest.json (kind "points",
/// details.faces_data_hash), the template, points_template.safetensors with its `vertices` (V, 3) float32, mouth open,
/// in the model frame; attributes.safetensors with `attributes` (faces, A) float32; shards/person-00000.safetensors
/// with `triangles` (n, S) int32 and `weights` (n, S, 2) float32. Vertices of faces are not stored again.
class PointDatabase {
 public:
  /// Maps every shard; reads the template. @throws Error naming file and cause: missing, truncated, of a newer version,
  /// shapes that differ from the manifest, or samples in triangles that the template does not have; a damaged file is
  /// found by its checksum unless Checksums::kSkip.
  explicit PointDatabase(const std::filesystem::path& directory, Checksums checksums = Checksums::kVerify);

  int num_faces() const { return num_faces_; }
  int num_vertices() const { return face_template_.num_vertices(); }
  /// S, of every face.
  int num_samples() const { return num_samples_; }
  /// @throws Error if there is no such face.
  SurfaceSamples samples(int face) const;

  /// The template with its mouth open in the model frame, 3V floats (x0 y0 z0 x1 ...).
  std::span<const float> template_vertices() const { return template_vertices_; }
  /// model_from_cm: of the template and of every face.
  const faces::ModelFrame& frame() const { return frame_; }
  /// The faces' own template, in cm, its mouth unchanged.
  const faces::FaceTemplate& face_template() const { return face_template_; }

  /// A names, defined in datasets/build/face_attributes.h.
  const std::vector<std::string>& attribute_names() const { return attribute_names_; }
  /// A numbers. @throws Error if there is no such face.
  std::span<const float> attributes(int face) const;
  const Manifest& manifest() const { return manifest_; }

 private:
  void CheckFace(int face) const;

  Manifest manifest_;
  int num_faces_ = 0, num_samples_ = 0, faces_per_shard_ = 0;
  faces::ModelFrame frame_;
  faces::FaceTemplate face_template_;
  std::vector<std::string> attribute_names_;
  std::vector<float> template_vertices_;
  std::optional<SafetensorsFile> attributes_;  ///< Always there once the constructor is done.
  std::vector<SafetensorsFile> shards_;
};

}  // namespace daumier::datasets
