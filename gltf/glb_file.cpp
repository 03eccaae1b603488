#include "gltf/glb_file.h"

#include "core/error.h"

#include <array>
#include <cstring>
#include <utility>

namespace daumier::gltf {
namespace {

constexpr uint32_t kGlbMagic = 0x46546C67, kGlbVersion = 2, kJsonType = 0x4E4F534A, kBinaryType = 0x004E4942;
constexpr size_t kJsonAt = 20;  // Behind the file's header and the chunk's.
constexpr int kByteType = 5121, kShortType = 5123, kIntType = 5125, kFloatType = 5126;

constexpr std::array<const char*, 4> kElementTypes = {"SCALAR", "VEC2", "VEC3", "VEC4"};

}  // namespace

void GlbFile::FailDamaged(const std::string& cause) const {
  throw Error(fmt::format("{}: is damaged: {}. Write it again with `daumier rig` or `daumier avatar`", name_, cause));
}

uint32_t GlbFile::Number(size_t at) const {
  if (bytes_.size() < 4 || at > bytes_.size() - 4) FailDamaged(fmt::format("it ends after {} bytes", bytes_.size()));
  uint32_t number = 0;
  std::memcpy(&number, bytes_.data() + at, sizeof number);
  return number;
}

GlbFile::GlbFile(std::string bytes, std::string name) : bytes_(std::move(bytes)), name_(std::move(name)) {
  DAUMIER_CHECK(bytes_.starts_with("glTF") && Number(0) == kGlbMagic,
                "{}: is no .glb. Give the head that `daumier rig` or `daumier avatar` wrote", name_);
  if (Number(4) != kGlbVersion) FailDamaged(fmt::format("version {} of glTF, expected 2", Number(4)));
  if (Number(8) != bytes_.size()) FailDamaged(fmt::format("it has {} bytes, expected {}", bytes_.size(), Number(8)));
  const size_t json_length = Number(12);
  if (Number(16) != kJsonType || json_length > bytes_.size() - kJsonAt) FailDamaged("its first chunk is no JSON");
  auto json = TryParseJson(std::string_view(bytes_).substr(kJsonAt, json_length));
  if (!json || !json->is_object()) FailDamaged("its first chunk is no JSON");
  json_ = std::move(*json);
  if (json_.contains("extensionsRequired"))
    throw Error(
        fmt::format("{}: is compressed. Give the plain .glb that was written next to it (without _compressed)", name_));
  const size_t chunk = kJsonAt + json_length;
  if (Number(chunk + 4) != kBinaryType || Number(chunk) != bytes_.size() - chunk - 8)
    FailDamaged("its second chunk is not the rest of the file");
  binary_ = std::string_view(bytes_).substr(chunk + 8);
}

int64_t GlbFile::Integer(const Json& value) const {
  if (!value.is_number_integer()) FailDamaged("an index or a size is no whole number");
  return value.get<int64_t>();
}

int64_t GlbFile::IntegerOr0(const Json& item, const char* key) const {
  return item.contains(key) ? Integer(item.at(key)) : 0;
}

const Json& GlbFile::Item(const char* list, const Json& number) const {
  const int64_t index = Integer(number);
  const Json& items = json_.at(list);
  if (!items.is_array() || index < 0 || index >= std::ssize(items))
    FailDamaged(fmt::format("there is no {} in {}", index, list));
  return items.at(size_t(index));
}

std::string_view GlbFile::ViewBytes(const Json& view) const {
  const Json& item = Item("bufferViews", view);
  const int64_t offset = IntegerOr0(item, "byteOffset"), length = Integer(item.at("byteLength"));
  const auto size = std::ssize(binary_);
  if (Integer(item.at("buffer")) != 0 || item.contains("byteStride") || offset < 0 || length < 0 || offset > size ||
      length > size - offset)
    FailDamaged(fmt::format("view {} is not in its buffer", Integer(view)));
  return binary_.substr(size_t(offset), size_t(length));
}

std::string_view GlbFile::Elements(const Json& accessor, size_t size) const {
  const std::string_view view = ViewBytes(accessor.at("bufferView"));
  const int64_t offset = IntegerOr0(accessor, "byteOffset"), count = Integer(accessor.at("count"));
  if (offset < 0 || count < 0 || offset > std::ssize(view) || count > (std::ssize(view) - offset) / int64_t(size) ||
      accessor.contains("sparse"))
    FailDamaged("an accessor is not in its view");
  return view.substr(size_t(offset), size_t(count) * size);
}

FloatRows GlbFile::Floats(const Json& index, int columns) const {
  const Json& accessor = Item("accessors", index);
  if (Integer(accessor.at("componentType")) != kFloatType ||
      accessor.at("type").get<std::string>() != kElementTypes.at(size_t(columns - 1)))
    FailDamaged(fmt::format("accessor {} has not {} floats an element", Integer(index), columns));
  const std::string_view bytes = Elements(accessor, sizeof(float) * size_t(columns));
  FloatRows values(std::ssize(bytes) / int64_t(sizeof(float)) / columns, columns);
  if (!bytes.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
  if (!values.allFinite()) FailDamaged(fmt::format("accessor {} has a number that is not finite", Integer(index)));
  return values;
}

std::vector<std::array<uint8_t, 4>> GlbFile::Colours(const Json& index) const {
  const Json& accessor = Item("accessors", index);
  if (Integer(accessor.at("componentType")) != kByteType || accessor.at("type").get<std::string>() != "VEC4")
    FailDamaged(fmt::format("accessor {} has no colours", Integer(index)));
  const std::string_view bytes = Elements(accessor, 4);
  std::vector<std::array<uint8_t, 4>> colours(bytes.size() / 4);
  if (!bytes.empty()) std::memcpy(colours.data(), bytes.data(), bytes.size());
  return colours;
}

std::vector<uint32_t> GlbFile::Indices(const Json& index, int64_t num_vertices) const {
  const Json& accessor = Item("accessors", index);
  const int64_t type = Integer(accessor.at("componentType"));
  if ((type != kShortType && type != kIntType) || accessor.at("type").get<std::string>() != "SCALAR")
    FailDamaged(fmt::format("accessor {} has no indices", Integer(index)));
  const size_t size = type == kShortType ? 2 : 4;
  const std::string_view bytes = Elements(accessor, size);
  std::vector<uint32_t> indices(bytes.size() / size);
  if (indices.empty() || indices.size() % 3 != 0)
    FailDamaged(fmt::format("accessor {} has no triangles", Integer(index)));
  for (size_t i = 0; i < indices.size(); ++i) {
    std::memcpy(&indices[i], bytes.data() + i * size, size);
    if (int64_t(indices[i]) >= num_vertices)
      FailDamaged(fmt::format("a corner is vertex {}, there are {}", indices[i], num_vertices));
  }
  return indices;
}

std::string_view GlbFile::ImageBytes(const Json& image) const {
  return ViewBytes(Item("images", image).at("bufferView"));
}

}  // namespace daumier::gltf
