#pragma once
#include "core/json.h"

#include <functional>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>

#include <Eigen/Core>

namespace daumier::studio {

/// Where packets of Live Link Face are received.
struct LiveLinkPlace {
  std::string address = "127.0.0.1";  ///< IPv4. Another one than this reaches beyond the machine.
  int port = 0;                       ///< 0: a free one.
};

/// A place as people type it: "11111", or "192.168.1.5:11111" with an address of this machine, "0.0.0.0:11111" with all of them.
/// @throws UsageError naming what is wrong.
LiveLinkPlace ParseLiveLinkPlace(std::string_view text);

/// Receives UDP packets of Live Link Face (rig::ParseLiveLinkPacket) on a thread of its own, as long as it exists. Packets are counted, and
/// those that are refused change nothing else.
class LiveLinkReceiver {
 public:
  /// take: gets the 52 weights, 0 to 1, of each packet with a face, one after the other. @throws UsageError if the address is none of
  /// this machine, or the port is taken.
  LiveLinkReceiver(const LiveLinkPlace& place, std::function<void(const Eigen::VectorXf& weights)> take);
  /// Returns when the thread has ended.
  ~LiveLinkReceiver();
  LiveLinkReceiver(const LiveLinkReceiver&) = delete;
  LiveLinkReceiver& operator=(const LiveLinkReceiver&) = delete;

  int port() const { return place_.port; }
  /// {address, port, packets, without_face, refused, subject: of the last packet or null, error: of the last refused one or null}.
  Json Describe() const;

 private:
  void Receive(std::stop_token stop);
  void Take(std::string_view bytes);

  LiveLinkPlace place_;
  const std::function<void(const Eigen::VectorXf& weights)> take_;
  int socket_ = -1;
  mutable std::mutex mutex_;  ///< Of the counts.
  int64_t num_packets_ = 0, num_without_face_ = 0, num_refused_ = 0;
  Json subject_, error_;
  std::jthread thread_;  ///< The last member: it uses all others.
};

}  // namespace daumier::studio
