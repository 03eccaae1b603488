#include "studio/live_link_receiver.h"

#include "core/error.h"
#include "core/random.h"
#include "tests/support/expect_error.h"
#include "tests/support/live_link_packets.h"
#include "tests/support/udp_sender.h"
#include "tests/support/warnings.h"

#include <gtest/gtest.h>

#include <chrono>
#include <vector>

namespace daumier::studio {
namespace {

using testing::ExpectError;
using testing::LiveLinkBytes;
using testing::UdpSender;

/// Keeps what a receiver gives.
class LiveLinkReceiverTest : public ::testing::Test {
 protected:
  std::vector<Eigen::VectorXf> Taken() const {
    const std::scoped_lock lock(mutex_);
    return taken_;
  }
  /// Waits until as many packets have come.
  Json After(int64_t num_packets) const {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(10);
    Json state = receiver_.Describe();
    while (state["packets"] < num_packets && std::chrono::steady_clock::now() < deadline) {
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
      state = receiver_.Describe();
    }
    return state;
  }

  mutable std::mutex mutex_;
  std::vector<Eigen::VectorXf> taken_;
  LiveLinkReceiver receiver_{{}, [this](const Eigen::VectorXf& weights) {
                               const std::scoped_lock lock(mutex_);
                               taken_.push_back(weights);
                             }};
};

std::vector<float> ValuesWith(size_t place, float value) {
  std::vector<float> values(61, 0.0f);
  values[place] = value;
  return values;
}

TEST_F(LiveLinkReceiverTest, GivesTheWeightsOfEachFace) {
  const UdpSender sender(receiver_.port());
  constexpr size_t kJawOpen = 17;
  sender.Send(LiveLinkBytes(ValuesWith(kJawOpen, 0.5f)));
  sender.Send(testing::LiveLinkBytesWithoutFace("phone", "Ann"));
  sender.Send(LiveLinkBytes(ValuesWith(0, 1)));
  const Json state = After(3);
  EXPECT_EQ(state["packets"], 3);
  EXPECT_EQ(state["without_face"], 1);
  EXPECT_EQ(state["refused"], 0);
  EXPECT_EQ(state["subject"], "iPhone");
  EXPECT_EQ(state["error"], Json());
  const std::vector<Eigen::VectorXf> taken = Taken();
  ASSERT_EQ(taken.size(), 2u);
  EXPECT_EQ(taken[0][kJawOpen], 0.5f);
  EXPECT_EQ(taken[0].sum(), 0.5f);
  EXPECT_EQ(taken[1][0], 1);
}

TEST_F(LiveLinkReceiverTest, OutlivesWrongPackets) {
  testing::AllowWarnings();
  const UdpSender sender(receiver_.port());
  const std::string good = LiveLinkBytes(ValuesWith(3, 0.25f));
  Rng rng(11);
  int64_t num_sent = 0;
  for (int i = 0; i < 200; ++i) {
    std::string damaged = good.substr(0, i % 3 == 0 ? rng.Below(good.size()) : good.size());
    for (uint64_t flip = 0; flip < 1 + rng.Below(4) && !damaged.empty(); ++flip)
      damaged[rng.Below(damaged.size())] = static_cast<char>(rng.Below(256));
    sender.Send(damaged);
    if (++num_sent % 20 == 0) After(num_sent);  // The kernel keeps few.
  }
  sender.Send(std::string(5000, '\x06'));
  Json state = After(++num_sent);
  EXPECT_EQ(state["packets"], num_sent);
  EXPECT_GT(state["refused"], 1);
  EXPECT_EQ(state["error"], "the packet has more than 4096 bytes");
  const size_t num_taken = Taken().size();
  sender.Send(good);
  After(++num_sent);
  ASSERT_EQ(Taken().size(), num_taken + 1);
  EXPECT_EQ(Taken().back()[3], 0.25f);
}

TEST_F(LiveLinkReceiverTest, ATakenPortIsRefused) {
  ExpectError([&] { LiveLinkReceiver({.port = receiver_.port()}, [](const Eigen::VectorXf&) {}); },
              "packets cannot be received at 127.0.0.1:" + std::to_string(receiver_.port()));
  ExpectError([] { LiveLinkReceiver({.address = "192.0.2.1"}, [](const Eigen::VectorXf&) {}); },
              "Name another port, or an address of this machine");
}

TEST(LiveLinkPlace, IsAPortOrAnAddressAndAPort) {
  EXPECT_EQ(ParseLiveLinkPlace("11111").address, "127.0.0.1") << "nobody outside the machine";
  EXPECT_EQ(ParseLiveLinkPlace("11111").port, 11111);
  EXPECT_EQ(ParseLiveLinkPlace("0.0.0.0:0").address, "0.0.0.0");
  EXPECT_EQ(ParseLiveLinkPlace("0.0.0.0:0").port, 0);
  for (const char* text : {"", ":", "70000", "-1", "1x", "phone:11111", "::1:80", "127.0.0.1:", "127.0.0.1"}) {
    EXPECT_THROW(ParseLiveLinkPlace(text), UsageError) << text;
    ExpectError([&] { ParseLiveLinkPlace(text); }, "is no place to receive at");
  }
}

}  // namespace
}  // namespace daumier::studio
