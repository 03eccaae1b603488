#include "rig/live_link_packet.h"

#include "core/error.h"
#include "rig/arkit_names.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace daumier::rig {
namespace {

constexpr uint8_t kPacketVersion = 6;
constexpr int kNumTurns = 9, kNumPacketValues = kNumArkitNames + kNumTurns;
constexpr int32_t kLongestPacketText = 1024;

/// Takes big-endian numbers from the front of a packet.
class PacketReader {
 public:
  explicit PacketReader(std::string_view bytes) : bytes_(bytes), size_(bytes.size()) {}

  bool is_at_end() const { return bytes_.empty(); }
  size_t num_left() const { return bytes_.size(); }

  std::string_view Take(size_t count, const char* what) {
    DAUMIER_CHECK(bytes_.size() >= count, "the packet of {} bytes ends within its {}", size_, what);
    const std::string_view taken = bytes_.substr(0, count);
    bytes_.remove_prefix(count);
    return taken;
  }
  uint8_t TakeByte(const char* what) { return static_cast<uint8_t>(Take(1, what).front()); }
  uint32_t TakeWord(const char* what) {
    uint32_t word = 0;
    for (const char c : Take(sizeof word, what)) word = word << 8 | static_cast<uint8_t>(c);
    return word;
  }
  int32_t TakeInteger(const char* what) { return static_cast<int32_t>(TakeWord(what)); }
  float TakeNumber(const char* what) {
    const auto number = std::bit_cast<float>(TakeWord(what));
    DAUMIER_CHECK(std::isfinite(number), "a number of the packet's {} is not finite", what);
    return number;
  }
  std::string TakeText(const char* what) {
    const int32_t length = TakeInteger(what);
    DAUMIER_CHECK(length >= 0 && length <= kLongestPacketText, "the packet's {} has {} bytes, expected 0 to {}", what,
                  length, kLongestPacketText);
    return std::string(Take(size_t(length), what));
  }

 private:
  std::string_view bytes_;
  size_t size_;
};

LiveLinkPacket::Frame TakeFrame(PacketReader& reader) {
  LiveLinkPacket::Frame frame;
  frame.number = reader.TakeInteger("time");
  frame.part = reader.TakeNumber("time");
  const int32_t numerator = reader.TakeInteger("rate"), denominator = reader.TakeInteger("rate");
  DAUMIER_CHECK(numerator > 0 && denominator > 0, "the packet's rate is {} / {}, expected a positive one", numerator,
                denominator);
  frame.rate = double(numerator) / denominator;
  const int count = reader.TakeByte("count");
  DAUMIER_CHECK(count == kNumPacketValues, "the packet has {} values, expected {}", count, kNumPacketValues);
  frame.weights.resize(kNumArkitNames);
  for (float& weight : frame.weights) weight = std::clamp(reader.TakeNumber("weights"), 0.0f, 1.0f);
  for (int i = 0; i < kNumTurns; ++i) reader.TakeNumber("rotations");
  return frame;
}

}  // namespace

LiveLinkPacket ParseLiveLinkPacket(std::string_view bytes) {
  PacketReader reader(bytes);
  const int version = reader.TakeByte("version");
  DAUMIER_CHECK(version == kPacketVersion,
                "the packet's version is {}, expected {}. Choose the mode Live Link (ARKit) in the app", version,
                kPacketVersion);
  LiveLinkPacket packet;
  packet.device = reader.TakeText("device");
  packet.subject = reader.TakeText("subject");
  if (reader.is_at_end()) return packet;
  packet.frame = TakeFrame(reader);
  DAUMIER_CHECK(reader.is_at_end(), "the packet has {} bytes behind its values", reader.num_left());
  return packet;
}

}  // namespace daumier::rig
