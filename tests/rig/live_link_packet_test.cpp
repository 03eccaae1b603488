#include "rig/live_link_packet.h"

#include "core/error.h"
#include "core/random.h"
#include "rig/arkit_names.h"
#include "tests/support/expect_error.h"
#include "tests/support/live_link_packets.h"

#include <gtest/gtest.h>

#include <limits>

namespace daumier::rig {
namespace {

using testing::ExpectError;
using testing::LiveLinkBytes;
using testing::LiveLinkBytesWithoutFace;

/// Value i of a packet is i / 100.
std::vector<float> Ramp() {
  std::vector<float> values;
  for (int i = 0; i < 61; ++i) values.push_back(float(i) / 100);
  return values;
}

TEST(LiveLinkPacket, HasTheSizesThatPublicReadersReport) {
  EXPECT_EQ(LiveLinkBytes(Ramp()).size(), 312u) << "36 bytes of a device and 'iPhone'";
  EXPECT_EQ(LiveLinkBytes(Ramp(), std::string(32, 'd'), std::string(18, 's')).size(), 320u);
}

TEST(LiveLinkPacket, IsReadNumberByNumber) {
  const LiveLinkPacket packet = ParseLiveLinkPacket(LiveLinkBytes(Ramp()));
  EXPECT_EQ(packet.device, "01234567-89AB-CDEF-0123-456789ABCDEF");
  EXPECT_EQ(packet.subject, "iPhone");
  ASSERT_TRUE(packet.frame);
  EXPECT_EQ(packet.frame->number, 1234);
  EXPECT_EQ(packet.frame->part, 0.5f);
  EXPECT_EQ(packet.frame->rate, 60);
  ASSERT_EQ(packet.frame->weights.size(), kNumArkitNames);
  for (int i = 0; i < kNumArkitNames; ++i) EXPECT_EQ(packet.frame->weights[i], float(i) / 100);
  // Unlike the app's CSV, a packet has left before right.
  EXPECT_EQ(*FindArkitName("jawLeft"), 15);
  EXPECT_EQ(*FindArkitName("mouthLeft"), 21);
}

TEST(LiveLinkPacket, BytesAreThoseWrittenByHand) {
  // A float32 of 1 is 3f 80 00 00, of 0.25 3e 80 00 00.
  std::string bytes(
      "\x06\0\0\0\x01"
      "d"
      "\0\0\0\x02"
      "su"
      "\0\0\0\x07"
      "\0\0\0\0"
      "\0\0\x75\x30"
      "\0\0\x03\xe9"
      "\x3d",
      29);
  bytes += std::string("\x3f\x80\0\0", 4) + std::string("\x3e\x80\0\0", 4) + std::string(59 * 4, '\0');
  const LiveLinkPacket packet = ParseLiveLinkPacket(bytes);
  EXPECT_EQ(packet.device, "d");
  EXPECT_EQ(packet.subject, "su");
  ASSERT_TRUE(packet.frame);
  EXPECT_EQ(packet.frame->number, 7);
  EXPECT_DOUBLE_EQ(packet.frame->rate, 30000.0 / 1001);
  EXPECT_EQ(packet.frame->weights[0], 1);
  EXPECT_EQ(packet.frame->weights[1], 0.25f);
  EXPECT_EQ(packet.frame->weights.tail(50).cwiseAbs().maxCoeff(), 0);
}

TEST(LiveLinkPacket, WithoutAFaceItEndsBehindTheSubject) {
  const LiveLinkPacket packet = ParseLiveLinkPacket(LiveLinkBytesWithoutFace("phone", "Ann"));
  EXPECT_EQ(packet.subject, "Ann");
  EXPECT_FALSE(packet.frame);
}

TEST(LiveLinkPacket, WeightsAreClamped) {
  std::vector<float> values(61, 0.0f);
  values[3] = -0.25f;
  values[17] = 1.5f;
  const LiveLinkPacket packet = ParseLiveLinkPacket(LiveLinkBytes(values));
  EXPECT_EQ(packet.frame->weights[3], 0);
  EXPECT_EQ(packet.frame->weights[17], 1);
}

TEST(LiveLinkPacket, SaysWhatIsWrong) {
  const auto refused = [](const std::string& bytes, const std::string& why) {
    ExpectError([&] { ParseLiveLinkPacket(bytes); }, why);
  };
  const std::string good = LiveLinkBytes(Ramp());
  refused("", "the packet of 0 bytes ends within its version");
  std::string bytes = good;
  bytes[0] = 1;
  refused(bytes, "the packet's version is 1, expected 6. Choose the mode Live Link (ARKit) in the app");
  bytes = good;
  bytes[1] = '\x7f';
  refused(bytes, "the packet's device has 2130706468 bytes, expected 0 to 1024");
  bytes[1] = '\xff';
  refused(bytes, "the packet's device has -16777180 bytes");
  bytes = std::string("\x06\0\0\4\0", 5) + "short";
  refused(bytes, "the packet of 10 bytes ends within its device");
  refused(good.substr(0, good.size() - 1), "the packet of 311 bytes ends within its rotations");
  refused(good + "x", "the packet has 1 bytes behind its values");
  refused(LiveLinkBytes(std::vector<float>(52, 0)), "the packet has 52 values, expected 61");
  std::vector<float> values = Ramp();
  values[5] = std::numeric_limits<float>::quiet_NaN();
  refused(LiveLinkBytes(values), "a number of the packet's weights is not finite");
  values[5] = 0;
  values[60] = std::numeric_limits<float>::infinity();
  refused(LiveLinkBytes(values), "a number of the packet's rotations is not finite");
  bytes = good;
  const size_t rate = 1 + 4 + 36 + 4 + 6 + 8;
  std::fill_n(bytes.begin() + rate, 4, '\0');
  refused(bytes, "the packet's rate is 0 / 1, expected a positive one");
}

TEST(LiveLinkPacket, DamagedOnesAreReadOrRefused) {
  const std::string good = LiveLinkBytes(Ramp());
  Rng rng(7);
  int num_read = 0;
  for (int i = 0; i < 200; ++i) {
    std::string damaged = good.substr(0, i % 3 == 0 ? rng.Below(good.size()) : good.size());
    for (uint64_t flip = 0; flip < 1 + rng.Below(4) && !damaged.empty(); ++flip)
      damaged[rng.Below(damaged.size())] = static_cast<char>(rng.Below(256));
    try {
      const LiveLinkPacket packet = ParseLiveLinkPacket(damaged);
      if (!packet.frame) continue;
      ++num_read;
      EXPECT_TRUE(packet.frame->weights.allFinite());
      EXPECT_GE(packet.frame->weights.minCoeff(), 0);
      EXPECT_LE(packet.frame->weights.maxCoeff(), 1);
    } catch (const Error&) {
    }
  }
  EXPECT_GT(num_read, 20) << "most bytes are those of values";
}

}  // namespace
}  // namespace daumier::rig
