#pragma once
#include "core/json.h"
#include "gltf/glb_builder.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace daumier::gltf {

/// A binary glTF 2.0 file as GlbBuilder writes it with GlbEncoding::kPlain: a JSON chunk, one binary chunk, accessors that
/// lie tightly in views. Every range is checked before it is read.
class GlbFile {
 public:
  /// `name` is the file in messages.
  /// @throws Error "NAME: cause. Repair" if the bytes are no such file: another format, cut off, or compressed.
  GlbFile(std::string bytes, std::string name);
  GlbFile(const GlbFile&) = delete;
  GlbFile& operator=(const GlbFile&) = delete;

  const std::string& name() const { return name_; }
  /// Its lists and keys may lack anything: read with at(), whose Json::exception means a damaged file.
  const Json& json() const { return json_; }
  /// An item of a list of the document ("nodes", "meshes" ...). @throws Error if there is none.
  const Json& Item(const char* list, int64_t index) const;

  /// count x columns of a float32 accessor. @throws Error on another type, a range outside the file, or a number that is
  /// not finite.
  FloatRows Floats(int64_t accessor, int columns) const;
  /// Colours of 4 bytes. @throws Error as Floats.
  std::vector<std::array<uint8_t, 4>> Colours(int64_t accessor) const;
  /// Corners of triangles, each below `num_vertices`. @throws Error as Floats, or if their number is no multiple of 3.
  std::vector<uint32_t> Indices(int64_t accessor, int64_t num_vertices) const;
  /// The file of an image. @throws Error if it lies outside the file.
  std::string_view ImageBytes(int64_t image) const;

  /// @throws Error "NAME: is damaged: CAUSE. Repair".
  [[noreturn]] void FailDamaged(const std::string& cause) const;

 private:
  uint32_t Number(size_t at) const;
  std::string_view ViewBytes(int64_t view) const;
  /// The bytes of an accessor whose elements have `size` bytes.
  std::string_view Elements(const Json& accessor, size_t size) const;

  std::string bytes_, name_;
  Json json_;
  std::string_view binary_;
};

}  // namespace daumier::gltf
