#pragma once
#include "core/json.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace daumier::gltf {

/// N x C, row-major: an element of an accessor a row.
using FloatRows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// How numbers lie in a .glb.
enum class GlbEncoding {
  kPlain,    ///< float32 as they are; every reader of glTF 2.0 reads it.
  kMeshopt,  ///< Rounded, then compressed: requires EXT_meshopt_compression of the reader.
};

/// Steps to which GlbEncoding::kMeshopt rounds, as exponents of 2.
inline constexpr int kPositionExponent = -16;      ///< m: an error of at most 0.008 mm.
inline constexpr int kDisplacementExponent = -15;  ///< m: at most 0.016 mm.
inline constexpr int kNormalExponent = -9;
inline constexpr int kUvExponent = -14;
inline constexpr int kWeightExponent = -12;

/// Assembles a binary glTF 2.0 file: a JSON chunk and one binary chunk, each array in a bufferView of its own.
/// Equal calls give equal bytes.
class GlbBuilder {
 public:
  explicit GlbBuilder(GlbEncoding encoding) : encoding_(encoding) {}

  GlbEncoding encoding() const { return encoding_; }
  /// The document: `asset`, `scene` and so on are set here.
  Json& json() { return json_; }

  /// Appends to a list of the document ("nodes", "meshes" ...), which is made where it is missing. Returns the index.
  int Add(const char* list, Json item);

  /// An attribute of vertices, float32, C = 1 .. 4 columns; with the bounds that POSITION requires, if `with_bounds`.
  /// Returns the accessor. `exponent`: of the step of kMeshopt.
  int AddAttribute(const FloatRows& values, int exponent, bool with_bounds = false);
  /// Colours of vertices, linear, 4 bytes each.
  int AddColors(std::span<const std::array<uint8_t, 4>> colors);
  /// Corners of triangles: 2 bytes each for up to 65,535 vertices, else 4.
  int AddIndices(std::span<const uint32_t> indices, int num_vertices);
  /// Times of keys in seconds, ascending, with bounds.
  int AddTimes(std::span<const float> times);
  /// Values of keys, float32; C columns are an element, or C scalars if `as_scalars`. `exponent` as in AddAttribute; an
  /// element that is not `as_scalars` is not rounded.
  int AddKeys(const FloatRows& values, bool as_scalars, int exponent);
  /// An image file. Returns the image.
  int AddImage(std::string_view bytes, const char* mime_type);

  /// The file. The builder is used up.
  std::string Finish();

 private:
  int AddRawView(std::string_view bytes, int target);
  int AddMeshoptView(size_t count, size_t stride, std::string_view encoded, const char* mode, const char* filter,
                     int target);
  /// `values` as they are or rounded, in a view.
  int AddFloatView(FloatRows& values, int exponent, int target);

  GlbEncoding encoding_;
  Json json_ = Json::object();
  std::string binary_;
  size_t fallback_size_ = 0;  ///< Bytes of the views that the extension decodes.
};

}  // namespace daumier::gltf
