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
  /// A whole number of the document. @throws Error if it is none.
  int64_t Integer(const Json& value) const;
  /// An item of a list of the document ("nodes", "meshes" ...). @throws Error if `number` is none of it.
  const Json& Item(const char* list, const Json& number) const;

  /// count x columns of a float32 accessor. @throws Error on another type, a range outside the file, or a number that is
  /// not finite.
  FloatRows Floats(const Json& accessor, int columns) const;
  /// Colours of 4 bytes. @throws Error as Floats.
  std::vector<std::array<uint8_t, 4>> Colours(const Json& accessor) const;
  /// Corners of triangles, each below `num_vertices`. @throws Error as Floats, or if their number is no multiple of 3.
  std::vector<uint32_t> Indices(const Json& accessor, int64_t num_vertices) const;
  /// The file of an image. @throws Error if it lies outside the file.
  std::string_view ImageBytes(const Json& image) const;
  size_t num_binary_bytes() const { return binary_.size(); }

  /// @throws Error "NAME: is damaged: CAUSE. Repair".
  [[noreturn]] void FailDamaged(const std::string& cause) const;

 private:
  uint32_t Number(size_t at) const;
  int64_t IntegerOr0(const Json& item, const char* key) const;
  std::string_view ViewBytes(const Json& view) const;
  /// The bytes of an accessor whose elements have `size` bytes.
  std::string_view Elements(const Json& accessor, size_t size) const;

  std::string bytes_, name_;
  Json json_;
  std::string_view binary_;
};

}  // namespace daumier::gltf
