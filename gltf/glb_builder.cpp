#include "gltf/glb_builder.h"

#include "core/error.h"
#include "gltf/meshopt_codec.h"

#include <bit>
#include <cstring>
#include <utility>

namespace daumier::gltf {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF is little-endian");

enum ComponentType { kUnsignedByte = 5121, kUnsignedShort = 5123, kUnsignedInt = 5125, kFloat = 5126 };
enum ViewTarget { kNoTarget = 0, kArrayBuffer = 34962, kElementArrayBuffer = 34963 };
constexpr uint32_t kMagic = 0x46546C67, kVersion = 2, kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;
constexpr const char* kMeshoptExtension = "EXT_meshopt_compression";

template <class T>
std::string_view BytesOf(std::span<const T> values) {
  return {reinterpret_cast<const char*>(values.data()), values.size_bytes()};
}

std::span<const float> Flat(const FloatRows& values) {
  return {values.data(), static_cast<size_t>(values.size())};
}

void AppendNumber(std::string& bytes, uint32_t number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

void PadTo4(std::string& bytes, char padding) {
  while (bytes.size() % 4 != 0) bytes += padding;
}

void AppendChunk(std::string& file, uint32_t type, std::string_view bytes) {
  AppendNumber(file, static_cast<uint32_t>(bytes.size()));
  AppendNumber(file, type);
  file += bytes;
}

const char* TypeOf(Eigen::Index columns) {
  static constexpr std::array<const char*, 4> kTypes = {"SCALAR", "VEC2", "VEC3", "VEC4"};
  DAUMIER_CHECK(columns >= 1 && columns <= 4, "an element of {} numbers, expected 1 .. 4", columns);
  return kTypes[size_t(columns - 1)];
}

Json Accessor(int view, ComponentType type, size_t count, const char* elements) {
  return {{"bufferView", view}, {"componentType", type}, {"count", count}, {"type", elements}};
}

void SetBounds(Json& accessor, const FloatRows& values) {
  accessor["min"] = Json::array();
  accessor["max"] = Json::array();
  for (Eigen::Index c = 0; c < values.cols(); ++c) {
    accessor["min"].push_back(values.col(c).minCoeff());
    accessor["max"].push_back(values.col(c).maxCoeff());
  }
}

}  // namespace

int GlbBuilder::Add(const char* list, Json item) {
  json_[list].push_back(std::move(item));
  return static_cast<int>(json_[list].size()) - 1;
}

int GlbBuilder::AddRawView(std::string_view bytes, int target) {
  Json view = {{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes.size()}};
  if (target != kNoTarget) view["target"] = target;
  binary_ += bytes;
  PadTo4(binary_, '\0');
  return Add("bufferViews", std::move(view));
}

int GlbBuilder::AddMeshoptView(size_t count, size_t stride, std::string_view encoded, const char* mode,
                               const char* filter, int target) {
  // What a reader without the extension would see is a buffer without data.
  Json view = {{"buffer", 1}, {"byteOffset", fallback_size_}, {"byteLength", count * stride}};
  if (target != kNoTarget) view["target"] = target;
  Json compressed = {{"buffer", 0},
                     {"byteOffset", binary_.size()},
                     {"byteLength", encoded.size()},
                     {"byteStride", stride},
                     {"count", count},
                     {"mode", mode}};
  if (filter != nullptr) compressed["filter"] = filter;
  view["extensions"][kMeshoptExtension] = std::move(compressed);
  fallback_size_ += (count * stride + 3) / 4 * 4;
  binary_ += encoded;
  PadTo4(binary_, '\0');
  return Add("bufferViews", std::move(view));
}

int GlbBuilder::AddFloatView(FloatRows& values, int exponent, int target) {
  if (encoding_ == GlbEncoding::kPlain) return AddRawView(BytesOf(Flat(values)), target);
  RoundToStep({values.data(), static_cast<size_t>(values.size())}, exponent);
  // A row is an element of the codec, which takes up to 256 bytes.
  const size_t most_columns = 64,
               columns = static_cast<size_t>(values.cols()) <= most_columns ? size_t(values.cols()) : 1;
  return AddMeshoptView(static_cast<size_t>(values.size()) / columns, columns * sizeof(float),
                        EncodeMultiples(Flat(values), columns, exponent), "ATTRIBUTES", "EXPONENTIAL", target);
}

int GlbBuilder::AddAttribute(const FloatRows& values, int exponent, bool with_bounds) {
  FloatRows stored = values;
  const int view = AddFloatView(stored, exponent, kArrayBuffer);
  Json accessor = Accessor(view, kFloat, static_cast<size_t>(values.rows()), TypeOf(values.cols()));
  if (with_bounds) SetBounds(accessor, stored);
  return Add("accessors", std::move(accessor));
}

int GlbBuilder::AddColors(std::span<const std::array<uint8_t, 4>> colors) {
  const std::string_view bytes = BytesOf(colors);
  const int view = encoding_ == GlbEncoding::kPlain ? AddRawView(bytes, kArrayBuffer)
                                                    : AddMeshoptView(colors.size(), 4, EncodeElements(bytes, 4),
                                                                     "ATTRIBUTES", nullptr, kArrayBuffer);
  Json accessor = Accessor(view, kUnsignedByte, colors.size(), "VEC4");
  accessor["normalized"] = true;
  return Add("accessors", std::move(accessor));
}

int GlbBuilder::AddIndices(std::span<const uint32_t> indices, int num_vertices) {
  const bool is_short = num_vertices <= 65535;  // The largest value of a type is no index.
  const ComponentType type = is_short ? kUnsignedShort : kUnsignedInt;
  int view = 0;
  if (encoding_ == GlbEncoding::kMeshopt) {
    view = AddMeshoptView(indices.size(), is_short ? 2 : 4, EncodeTriangles(indices, static_cast<size_t>(num_vertices)),
                          "TRIANGLES", nullptr, kElementArrayBuffer);
  } else if (is_short) {
    const std::vector<uint16_t> narrow(indices.begin(), indices.end());
    view = AddRawView(BytesOf(std::span<const uint16_t>(narrow)), kElementArrayBuffer);
  } else {
    view = AddRawView(BytesOf(indices), kElementArrayBuffer);
  }
  return Add("accessors", Accessor(view, type, indices.size(), "SCALAR"));
}

int GlbBuilder::AddTimes(std::span<const float> times) {
  Json accessor = Accessor(AddRawView(BytesOf(times), kNoTarget), kFloat, times.size(), "SCALAR");
  accessor["min"] = {times.front()};
  accessor["max"] = {times.back()};
  return Add("accessors", std::move(accessor));
}

int GlbBuilder::AddKeys(const FloatRows& values, bool as_scalars, int exponent) {
  if (!as_scalars) {
    const int view = AddRawView(BytesOf(Flat(values)), kNoTarget);
    return Add("accessors", Accessor(view, kFloat, static_cast<size_t>(values.rows()), TypeOf(values.cols())));
  }
  FloatRows stored = values;
  const int view = AddFloatView(stored, exponent, kNoTarget);
  return Add("accessors", Accessor(view, kFloat, static_cast<size_t>(values.size()), "SCALAR"));
}

int GlbBuilder::AddImage(std::string_view bytes, const char* mime_type) {
  return Add("images", {{"bufferView", AddRawView(bytes, kNoTarget)}, {"mimeType", mime_type}});
}

std::string GlbBuilder::Finish() {
  json_["buffers"] = Json::array({{{"byteLength", binary_.size()}}});
  if (fallback_size_ > 0) {
    Json fallback = {{"byteLength", fallback_size_}};
    fallback["extensions"][kMeshoptExtension]["fallback"] = true;
    json_["buffers"].push_back(std::move(fallback));
    json_["extensionsUsed"].push_back(kMeshoptExtension);
    json_["extensionsRequired"].push_back(kMeshoptExtension);
  }
  std::string text = json_.dump();
  PadTo4(text, ' ');
  std::string file;
  file.reserve(28 + text.size() + binary_.size());
  AppendNumber(file, kMagic);
  AppendNumber(file, kVersion);
  AppendNumber(file, static_cast<uint32_t>(28 + text.size() + binary_.size()));
  AppendChunk(file, kJsonChunk, text);
  AppendChunk(file, kBinaryChunk, binary_);
  return file;
}

}  // namespace daumier::gltf
