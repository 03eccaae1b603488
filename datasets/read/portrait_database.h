#pragma once
#include "core/manifest.h"
#include "core/picture_parts.h"
#include "core/safetensors.h"
#include "faces/face_model.h"
#include "render/image.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace daumier::datasets {

/// Numbers of a portrait's coefficients; unused ones at the end are 0.
struct PortraitSizes {
  static constexpr int kExpression = 64;  ///< Weights of the source's expression shapes, 0..1.
  static constexpr int kAlbedo = 80;      ///< Of the albedo basis, unit sigma.
  static constexpr int kLight = 9;        ///< Spherical harmonics, monochrome.
  static constexpr int kPose = 6;         ///< Pitch, yaw, roll (radians), t_x, t_y, t_z (cm).
  static constexpr int kLandmarks = 68;
};

/// A folder of portraits on disk, made of the neutral faces of a FaceDatabase (details.faces_data_hash) or imported:
/// manifest.json (kind "portraits"), the template, shards/portraits-00000.safetensors of some images each. With n
/// images, a shard has
///   pictures (bytes) uint8, picture_offsets (n + 1) int64: a PNG or JPEG file each, RGB, size x size pixels;
///   masks (bytes) uint8, mask_offsets (n + 1) int64: a grey PNG file each, of PictureClass;
///   landmarks (n, 68, 2) float32 px, visibility (n, 68) uint8, states (n, 3) float32 mm,
///   expression (n, 64), albedo (n, 80), light (n, 9), pose (n, 6) float32,
///   faces, persons, styles, skin_tones (n) int32, bald (n) uint8, eye_sizes (n) float32,
/// and where details.vertices is true vertices (n, V, 3, 2) uint8: int16, low byte first, in units of 0.001 cm.
/// Where details.known_faces is false (pictures of other origin) there is no template; expression, albedo, light and pose
/// are 0, and states say nothing.
/// Images of a person are next to each other. A camera sees a vertex p of vertices(i) at
///   q = R p + t, R = Rz(roll) Ry(yaw) Rx(pitch),
///   x = size / 2 + focal q_x / (distance - q_z), y = size / 2 - focal q_y / (distance - q_z),
/// focal in pixels and distance in cm as focal() and distance() return them.
class PortraitDatabase {
 public:
  /// Maps every shard; reads the template. @throws Error naming file and cause: missing, truncated, of a newer version,
  /// shapes that differ from the manifest, offsets that do not rise, values out of range; a damaged file is found by its
  /// checksum unless Checksums::kSkip.
  explicit PortraitDatabase(const std::filesystem::path& directory, Checksums checksums = Checksums::kVerify);

  // Of each of these, i is an image. @throws Error if there is no such image.

  int size() const { return first_.back(); }
  /// RGB, image_size() square. @throws Error if its bytes are no such picture.
  render::Image picture(int i) const;
  /// Grey, image_size() square: PictureClass of each pixel. @throws Error if its bytes are no such picture.
  render::Image mask(int i) const;
  /// 68 x 2, pixels of the picture (x0 y0 x1 y1 ...); also of points that are hidden or outside of it.
  std::vector<float> landmarks(int i) const;
  /// 68: 1 seen; 0 hidden by the head itself or what it wears, or outside of the picture.
  std::vector<uint8_t> visibility(int i) const;
  std::span<const float> expression(int i) const;
  std::span<const float> albedo(int i) const;
  std::span<const float> light(int i) const;
  std::span<const float> pose(int i) const;
  /// Of the FaceDatabase: the neutral face, and its person; where faces are not known, those that have one number are
  /// taken for one person.
  int face(int i) const;
  int person(int i) const;
  /// Value of the control eye_size (faces/controls/), left and right, that enlarged the eyes of that neutral face; 0: none did.
  float eye_size(int i) const;
  /// Whether coefficients, states and vertices are true, and there is a template.
  bool has_known_faces() const { return face_template_.num_vertices() > 0; }
  /// Whether the vertices were stored.
  bool has_vertices() const { return has_vertices_; }
  /// V x 3, cm: the face with its expression, not posed, moved so that the mean of the template's neutral 68 landmarks
  /// is at 0. Rounded to 0.001 cm. @throws Error unless has_vertices().
  geometry::Points vertices(int i) const;
  /// The name of the style that the picture is drawn in.
  std::string style(int i) const;
  /// Without hair, brows and texture: a head of clay.
  bool is_bald(int i) const;
  /// Gaps between the lids of the right eye (the face's own, landmarks 36 to 41), of the left eye, and between the
  /// lips, mm; 0 or less where closed.
  std::array<float, 3> states(int i) const;
  /// From 0, the lightest, to 5; 0 where faces are not known.
  int skin_tone(int i) const;

  int image_size() const { return image_size_; }
  double focal() const { return focal_; }        ///< Pixels.
  double distance() const { return distance_; }  ///< From the viewer to the origin, cm.
  /// What was subtracted from the faces' vertices: the mean of the template's neutral 68 landmarks, cm.
  const geometry::Vector3& centre() const { return centre_; }
  /// Of the expression coefficients that are in use, at most 64.
  const std::vector<std::string>& expression_names() const { return expression_names_; }
  const std::vector<std::string>& style_names() const { return style_names_; }
  const Manifest& manifest() const { return manifest_; }
  const faces::FaceTemplate& face_template() const { return face_template_; }

 private:
  /// The shard of an image, and its row there.
  std::pair<const SafetensorsFile*, int> Find(int i) const;
  template <class T>
  std::span<const T> Row(int i, const char* array, int count) const;
  render::Image Decode(int i, const std::string& bytes, const std::string& offsets, int channels) const;

  std::filesystem::path directory_;
  Manifest manifest_;
  faces::FaceTemplate face_template_;
  std::vector<std::string> expression_names_, style_names_;
  int image_size_ = 0;
  double focal_ = 0, distance_ = 0;
  geometry::Vector3 centre_ = geometry::Vector3::Zero();
  bool has_vertices_ = false;
  std::vector<int> first_ = {0};  ///< The first image of each shard, then the number of all.
  std::vector<SafetensorsFile> shards_;
};

/// The file of a shard inside a database's folder: shards/portraits-00000.safetensors.
std::string PortraitShardName(int shard);

}  // namespace daumier::datasets
