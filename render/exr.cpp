#include "render/exr.h"

#include "core/error.h"

#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace daumier::render {
namespace {

constexpr uint32_t kMagic = 20000630, kVersion = 2;
constexpr int kBlockLines = 16;  // Of ZIP compression.
constexpr uint8_t kZipCompression = 3, kIncreasingY = 0;
constexpr int32_t kFloatPixels = 2;
constexpr size_t kLongestName = 31;
constexpr int kLargestSide = 1 << 16;

template <class T>
void Put(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);  // Little-endian, as our machines are.
}

void PutAttribute(std::string& bytes, const char* name, const char* type, const std::string& value) {
  bytes.append(name).push_back('\0');
  bytes.append(type).push_back('\0');
  Put(bytes, static_cast<int32_t>(value.size()));
  bytes += value;
}

/// Bytes of even places, then of odd ones, each but the first as its difference from the one before, plus 128.
std::string Predicted(const std::string& raw) {
  std::string sorted(raw.size(), '\0');
  const size_t half = (raw.size() + 1) / 2;
  for (size_t i = 0; i < raw.size(); ++i) sorted[i / 2 + (i % 2 ? half : 0)] = raw[i];
  for (size_t i = sorted.size(); i-- > 1;)
    sorted[i] = static_cast<char>(uint8_t(sorted[i]) - uint8_t(sorted[i - 1]) + 128);
  return sorted;
}

std::string Unpredicted(std::string sorted) {
  for (size_t i = 1; i < sorted.size(); ++i)
    sorted[i] = static_cast<char>(uint8_t(sorted[i - 1]) + uint8_t(sorted[i]) - 128);
  std::string raw(sorted.size(), '\0');
  const size_t half = (sorted.size() + 1) / 2;
  for (size_t i = 0; i < raw.size(); ++i) raw[i] = sorted[i / 2 + (i % 2 ? half : 0)];
  return raw;
}

std::string Deflated(const std::string& raw) {
  const std::string predicted = Predicted(raw);
  uLongf size = compressBound(static_cast<uLong>(predicted.size()));
  std::string packed(size, '\0');
  const int code = compress2(reinterpret_cast<Bytef*>(packed.data()), &size,
                             reinterpret_cast<const Bytef*>(predicted.data()), static_cast<uLong>(predicted.size()), 4);
  DAUMIER_CHECK(code == Z_OK, "zlib cannot compress a block of {} bytes (code {})", raw.size(), code);
  packed.resize(size);
  return packed.size() < raw.size() ? packed : raw;  // A block that does not become smaller is stored.
}

std::string Header(const FloatImage& image) {
  std::string channels, window, bytes;
  for (const auto& [name, values] : image.channels) {
    channels.append(name).push_back('\0');
    Put(channels, kFloatPixels);
    Put(channels, int32_t(0));  // Perceptually linear: unused; three reserved bytes.
    Put(channels, int32_t(1));  // Every pixel along x and y.
    Put(channels, int32_t(1));
  }
  channels.push_back('\0');
  for (const int32_t corner : {0, 0, image.width - 1, image.height - 1}) Put(window, corner);
  Put(bytes, kMagic);
  Put(bytes, kVersion);
  std::string one, zero_zero;
  Put(one, 1.0f);
  Put(zero_zero, 0.0f);
  Put(zero_zero, 0.0f);
  PutAttribute(bytes, "channels", "chlist", channels);
  PutAttribute(bytes, "compression", "compression", std::string(1, char(kZipCompression)));
  PutAttribute(bytes, "dataWindow", "box2i", window);
  PutAttribute(bytes, "displayWindow", "box2i", window);
  PutAttribute(bytes, "lineOrder", "lineOrder", std::string(1, char(kIncreasingY)));
  PutAttribute(bytes, "pixelAspectRatio", "float", one);
  PutAttribute(bytes, "screenWindowCenter", "v2f", zero_zero);
  PutAttribute(bytes, "screenWindowWidth", "float", one);
  bytes.push_back('\0');
  return bytes;
}

/// A position in a file that is read.
class ExrReader {
 public:
  ExrReader(std::string_view bytes, std::string_view name) : bytes_(bytes), name_(name) {}

  std::string_view Take(size_t count) {
    DAUMIER_CHECK(count <= bytes_.size() - place_, "{}: truncated OpenEXR file", name_);
    place_ += count;
    return bytes_.substr(place_ - count, count);
  }
  template <class T>
  T Number() {
    T value;
    std::memcpy(&value, Take(sizeof value).data(), sizeof value);
    return value;
  }
  std::string Text() {
    const size_t end = bytes_.find('\0', place_);
    DAUMIER_CHECK(end != std::string_view::npos && end - place_ < 256, "{}: damaged OpenEXR header", name_);
    std::string text(Take(end - place_));
    Take(1);
    return text;
  }
  size_t place() const { return place_; }

 private:
  std::string_view bytes_, name_;
  size_t place_ = 0;
};

struct ExrLayout {
  int height = 0, width = 0;
  std::vector<std::string> names;
  bool has_zip = false, has_increasing_lines = true;
};

std::vector<std::string> ChannelNames(std::string_view value, std::string_view name) {
  ExrReader reader(value, name);
  std::vector<std::string> names;
  for (std::string channel = reader.Text(); !channel.empty(); channel = reader.Text()) {
    const auto type = reader.Number<int32_t>();
    reader.Number<int32_t>();
    const auto x = reader.Number<int32_t>(), y = reader.Number<int32_t>();
    DAUMIER_CHECK(type == kFloatPixels && x == 1 && y == 1, "{}: channel {} is not one of 32-bit floats at every pixel",
                  name, channel);
    names.push_back(channel);
  }
  return names;
}

ExrLayout ReadHeader(ExrReader& reader, std::string_view name) {
  DAUMIER_CHECK(reader.Number<uint32_t>() == kMagic, "{}: not an OpenEXR file", name);
  DAUMIER_CHECK(reader.Number<uint32_t>() == kVersion, "{}: an OpenEXR file of tiles, parts or another version", name);
  ExrLayout layout;
  for (std::string key = reader.Text(); !key.empty(); key = reader.Text()) {
    const std::string type = reader.Text();
    const auto size = reader.Number<int32_t>();
    DAUMIER_CHECK(size >= 0, "{}: damaged OpenEXR header", name);
    ExrReader value(reader.Take(size_t(size)), name);
    if (key == "channels") {
      layout.names = ChannelNames(value.Take(size_t(size)), name);
    } else if (key == "compression") {
      layout.has_zip = value.Number<uint8_t>() == kZipCompression;
    } else if (key == "lineOrder") {
      layout.has_increasing_lines = value.Number<uint8_t>() == kIncreasingY;
    } else if (key == "dataWindow") {
      const auto left = value.Number<int32_t>(), top = value.Number<int32_t>(), right = value.Number<int32_t>(),
                 bottom = value.Number<int32_t>();
      DAUMIER_CHECK(left == 0 && top == 0 && right >= 0 && bottom >= 0 && right < kLargestSide && bottom < kLargestSide,
                    "{}: a data window from ({}, {}) to ({}, {})", name, left, top, right, bottom);
      layout.width = right + 1;
      layout.height = bottom + 1;
    }
  }
  DAUMIER_CHECK(layout.height > 0 && !layout.names.empty() && layout.has_zip && layout.has_increasing_lines,
                "{}: not an OpenEXR file of scan lines with ZIP compression", name);
  return layout;
}

}  // namespace

std::string EncodeExr(const FloatImage& image) {
  const size_t size = size_t(std::max(0, image.height)) * size_t(std::max(0, image.width));
  DAUMIER_CHECK(size > 0 && image.height <= kLargestSide && image.width <= kLargestSide && !image.channels.empty(),
                "an OpenEXR picture of {} x {} pixels and {} channels", image.height, image.width,
                image.channels.size());
  for (const auto& [name, values] : image.channels) {
    DAUMIER_CHECK(!name.empty() && name.size() <= kLongestName, "'{}' is no name of a channel", name);
    DAUMIER_CHECK(values.size() == size, "channel {} has {} values, expected {}", name, values.size(), size);
  }
  std::string bytes = Header(image);
  std::vector<std::string> blocks;
  for (int first = 0; first < image.height; first += kBlockLines) {
    std::string raw;
    for (int row = first; row < std::min(image.height, first + kBlockLines); ++row)
      for (const auto& [name, values] : image.channels)
        raw.append(reinterpret_cast<const char*>(values.data() + size_t(row) * image.width),
                   size_t(image.width) * sizeof(float));
    blocks.push_back(Deflated(raw));
  }
  uint64_t offset = bytes.size() + blocks.size() * sizeof(uint64_t);
  for (const std::string& block : blocks) {
    Put(bytes, offset);
    offset += 2 * sizeof(int32_t) + block.size();
  }
  for (size_t b = 0; b < blocks.size(); ++b) {
    Put(bytes, static_cast<int32_t>(b) * kBlockLines);
    Put(bytes, static_cast<int32_t>(blocks[b].size()));
    bytes += blocks[b];
  }
  return bytes;
}

FloatImage DecodeExr(std::string_view bytes, std::string_view name) {
  ExrReader reader(bytes, name);
  const ExrLayout layout = ReadHeader(reader, name);
  FloatImage image{layout.height, layout.width, {}};
  const int num_blocks = (layout.height + kBlockLines - 1) / kBlockLines;
  reader.Take(size_t(num_blocks) * sizeof(uint64_t));  // Blocks follow each other.
  for (const std::string& channel : layout.names) image.channels[channel].resize(size_t(layout.height) * layout.width);
  const size_t line = size_t(layout.width) * sizeof(float);
  for (int first = 0; first < layout.height; first += kBlockLines) {
    const int lines = std::min(kBlockLines, layout.height - first);
    const size_t size = size_t(lines) * layout.names.size() * line;
    DAUMIER_CHECK(reader.Number<int32_t>() == first, "{}: its blocks of lines are not in order", name);
    const auto packed_size = reader.Number<int32_t>();
    DAUMIER_CHECK(packed_size >= 0 && size_t(packed_size) <= size, "{}: damaged block of lines", name);
    std::string raw(reader.Take(size_t(packed_size)));
    if (raw.size() < size) {
      std::string predicted(size, '\0');
      auto length = static_cast<uLongf>(size);
      const int code = uncompress(reinterpret_cast<Bytef*>(predicted.data()), &length,
                                  reinterpret_cast<const Bytef*>(raw.data()), static_cast<uLong>(raw.size()));
      DAUMIER_CHECK(code == Z_OK && length == size, "{}: damaged block of lines", name);
      raw = Unpredicted(std::move(predicted));
    }
    const char* from = raw.data();
    for (int row = first; row < first + lines; ++row) {
      for (const std::string& channel : layout.names) {
        std::memcpy(image.channels[channel].data() + size_t(row) * layout.width, from, line);
        from += line;
      }
    }
  }
  return image;
}

}  // namespace daumier::render
