#include "train/event_file.h"

#include "core/crc32c.h"
#include "core/error.h"
#include "core/files.h"

#include <bit>
#include <cstring>
#include <optional>
#include <string_view>

namespace daumier::train {
namespace {

static_assert(std::endian::native == std::endian::little, "event files are written on little-endian machines only");

constexpr std::string_view kFileVersion = "brain.Event:2";
enum WireType { kVarint = 0, kFixed64 = 1, kBytes = 2, kFixed32 = 5 };

uint32_t MaskedCrc(std::string_view bytes) {
  const uint32_t crc = Crc32c(bytes);
  return ((crc >> 15) | (crc << 17)) + 0xa282ead8u;
}

template <class T>
std::string Raw(T value) {
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  return bytes;
}

std::string Varint(uint64_t value) {
  std::string bytes;
  for (; value >= 0x80; value >>= 7) bytes += char(value | 0x80);
  return bytes + char(value);
}

std::string Key(int field, WireType type) {
  return Varint(uint64_t(field) << 3 | type);
}

std::string BytesField(int field, std::string_view bytes) {
  return Key(field, kBytes) + Varint(bytes.size()) + std::string(bytes);
}

std::string EventMessage(double wall_time, int64_t step, const std::string& payload) {
  return Key(1, kFixed64) + Raw(wall_time) + Key(2, kVarint) + Varint(uint64_t(step)) + payload;
}

std::string Record(const std::string& message) {
  const std::string length = Raw(uint64_t(message.size()));
  return length + Raw(MaskedCrc(length)) + message + Raw(MaskedCrc(message));
}

/// Takes values off the front of a message; every read checks what is left.
class MessageReader {
 public:
  explicit MessageReader(std::string_view bytes) : bytes_(bytes) {}

  bool done() const { return bytes_.empty(); }

  template <class T>
  T Fixed() {
    T value;
    std::memcpy(&value, Take(sizeof(T)).data(), sizeof(T));
    return value;
  }
  uint64_t TakeVarint() {
    uint64_t value = 0;
    for (int shift = 0; shift < 64; shift += 7) {
      const uint8_t byte = uint8_t(Take(1)[0]);
      value |= uint64_t(byte & 0x7f) << shift;
      if (byte < 0x80) break;
    }
    return value;
  }
  std::string_view TakeBytes() { return Take(TakeVarint()); }
  std::string_view Take(uint64_t count) {
    DAUMIER_CHECK(count <= bytes_.size(), "an event ends too early");
    const std::string_view taken = bytes_.substr(0, count);
    bytes_.remove_prefix(count);
    return taken;
  }
  void Skip(uint64_t key) {
    switch (key & 7) {
      case kVarint:
        TakeVarint();
        break;
      case kFixed64:
        Take(8);
        break;
      case kBytes:
        TakeBytes();
        break;
      case kFixed32:
        Take(4);
        break;
      default:
        throw Error(fmt::format("an event has a field of the unknown wire type {}", key & 7));
    }
  }

 private:
  std::string_view bytes_;
};

void ReadValue(std::string_view bytes, ScalarEvent& event) {
  for (MessageReader reader(bytes); !reader.done();) {
    const uint64_t key = reader.TakeVarint();
    if (key == (1 << 3 | kBytes)) {
      event.tag = reader.TakeBytes();
    } else if (key == (2 << 3 | kFixed32)) {
      event.value = reader.Fixed<float>();
    } else {
      reader.Skip(key);
    }
  }
}

void ReadMessage(std::string_view message, std::vector<ScalarEvent>& events) {
  ScalarEvent event;
  std::vector<std::string_view> summaries;
  for (MessageReader reader(message); !reader.done();) {
    const uint64_t key = reader.TakeVarint();
    if (key == (1 << 3 | kFixed64)) {
      event.wall_time = reader.Fixed<double>();
    } else if (key == (2 << 3 | kVarint)) {
      event.step = int64_t(reader.TakeVarint());
    } else if (key == (5 << 3 | kBytes)) {
      summaries.push_back(reader.TakeBytes());
    } else {
      reader.Skip(key);
    }
  }
  for (const std::string_view summary : summaries) {
    for (MessageReader reader(summary); !reader.done();) {
      const uint64_t key = reader.TakeVarint();
      if (key == (1 << 3 | kBytes)) {
        ReadValue(reader.TakeBytes(), event);
        events.push_back(event);
      } else {
        reader.Skip(key);
      }
    }
  }
}

/// The message at the front of `bytes`, which loses the record; nothing if the record is truncated or damaged.
std::optional<std::string_view> TakeRecord(std::string_view& bytes) {
  constexpr size_t kAround = sizeof(uint64_t) + 2 * sizeof(uint32_t);
  if (bytes.size() < kAround) return std::nullopt;
  MessageReader reader(bytes);
  const std::string_view length_bytes = reader.Take(sizeof(uint64_t));
  const uint64_t length = MessageReader(length_bytes).Fixed<uint64_t>();
  if (reader.Fixed<uint32_t>() != MaskedCrc(length_bytes) || length > bytes.size() - kAround) return std::nullopt;
  const std::string_view message = reader.Take(length);
  if (reader.Fixed<uint32_t>() != MaskedCrc(message)) return std::nullopt;
  bytes.remove_prefix(kAround + length);
  return message;
}

}  // namespace

EventWriter::EventWriter(const std::filesystem::path& file)
    : path_(file), stream_(file, std::ios::binary | std::ios::app) {
  DAUMIER_CHECK(stream_.is_open(), "{} cannot be opened for writing", file.string());
  if (stream_.tellp() == 0) stream_ << Record(EventMessage(0, 0, BytesField(3, kFileVersion))) << std::flush;
  DAUMIER_CHECK(stream_.good(), "{} cannot be written: is the disk full?", path_.string());
}

void EventWriter::Write(const ScalarEvent& event) {
  const std::string value = BytesField(1, event.tag) + Key(2, kFixed32) + Raw(event.value);
  stream_ << Record(EventMessage(event.wall_time, event.step, BytesField(5, BytesField(1, value)))) << std::flush;
  DAUMIER_CHECK(stream_.good(), "{} cannot be written: is the disk full?", path_.string());
}

std::vector<ScalarEvent> ReadEvents(const std::filesystem::path& file) {
  const std::string content = ReadFile(file);
  std::string_view rest = content;
  const std::optional<std::string_view> head = TakeRecord(rest);
  DAUMIER_CHECK(head && head->find(kFileVersion) != std::string_view::npos, "{} is no TensorBoard event file",
                file.string());
  std::vector<ScalarEvent> events;
  while (const std::optional<std::string_view> message = TakeRecord(rest)) ReadMessage(*message, events);
  return events;
}

}  // namespace daumier::train
