#include "studio/live_link_receiver.h"

#include "core/error.h"
#include "core/log.h"
#include "rig/live_link_packet.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <charconv>
#include <cstring>
#include <optional>
#include <utility>

namespace daumier::studio {
namespace {

constexpr int kGreatestPort = 65535;
constexpr size_t kLongestPacket = 4096;  // One with a face has some 320 bytes.
constexpr int kPollMs = 50;

std::optional<in_addr> AddressOf(const std::string& text) {
  in_addr address{};
  if (inet_pton(AF_INET, text.c_str(), &address) != 1) return std::nullopt;
  return address;
}

/// Not bound yet.
int OpenUdpSocket() {
  const int opened = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  DAUMIER_CHECK(opened >= 0, "no socket can be opened: {}", std::strerror(errno));
  return opened;
}

/// The port that a socket is bound to.
int PortOf(int socket) {
  sockaddr_in bound{};
  socklen_t size = sizeof bound;
  getsockname(socket, reinterpret_cast<sockaddr*>(&bound), &size);
  return ntohs(bound.sin_port);
}

}  // namespace

LiveLinkPlace ParseLiveLinkPlace(std::string_view text) {
  LiveLinkPlace place;
  std::string_view port = text;
  if (const size_t colon = text.rfind(':'); colon != std::string_view::npos) {
    place.address = text.substr(0, colon);
    port = text.substr(colon + 1);
  }
  const auto [end, failure] = std::from_chars(port.data(), port.data() + port.size(), place.port);
  const bool is_port = failure == std::errc() && end == port.data() + port.size() && place.port >= 0;
  if (!is_port || place.port > kGreatestPort || !AddressOf(place.address))
    throw UsageError(
        fmt::format("'{}' is no place to receive at, expected a port such as {} or ADDRESS:PORT such as "
                    "0.0.0.0:{}",
                    text.substr(0, 60), rig::kLiveLinkPort, rig::kLiveLinkPort));
  return place;
}

LiveLinkReceiver::LiveLinkReceiver(const LiveLinkPlace& place, std::function<void(const Eigen::VectorXf& weights)> take)
    : place_(place), take_(std::move(take)) {
  const std::optional<in_addr> address = AddressOf(place.address);
  if (!address) throw UsageError(fmt::format("'{}' is no address of IPv4", place.address));
  socket_ = OpenUdpSocket();
  sockaddr_in local{};
  local.sin_family = AF_INET;
  local.sin_port = htons(static_cast<uint16_t>(place.port));
  local.sin_addr = *address;
  if (bind(socket_, reinterpret_cast<const sockaddr*>(&local), sizeof local) != 0) {
    const std::string cause = std::strerror(errno);
    close(socket_);
    throw UsageError(
        fmt::format("packets cannot be received at {}:{}: {}. Name another port, or an address of this "
                    "machine",
                    place.address, place.port, cause));
  }
  place_.port = PortOf(socket_);
  thread_ = std::jthread([this](std::stop_token stop) { Receive(std::move(stop)); });
}

LiveLinkReceiver::~LiveLinkReceiver() {
  thread_.request_stop();
  thread_.join();
  close(socket_);
}

void LiveLinkReceiver::Receive(std::stop_token stop) {
  std::array<char, kLongestPacket + 1> bytes;  // One more, so that a longer packet is seen.
  while (!stop.stop_requested()) {
    pollfd waiting{socket_, POLLIN, 0};
    if (poll(&waiting, 1, kPollMs) <= 0) continue;
    const ssize_t size = recv(socket_, bytes.data(), bytes.size(), 0);
    if (size >= 0) Take({bytes.data(), size_t(size)});
  }
}

void LiveLinkReceiver::Take(std::string_view bytes) {
  try {
    DAUMIER_CHECK(bytes.size() <= kLongestPacket, "the packet has more than {} bytes", kLongestPacket);
    const rig::LiveLinkPacket packet = rig::ParseLiveLinkPacket(bytes);
    {
      const std::scoped_lock lock(mutex_);
      ++num_packets_;
      num_without_face_ += packet.frame ? 0 : 1;
      subject_ = packet.subject;
    }
    if (packet.frame) take_(packet.frame->weights);
  } catch (const Error& error) {
    const std::scoped_lock lock(mutex_);
    if (num_refused_ == 0) log::Warn("Live Link: {}. Later ones are counted", error.what());
    ++num_packets_;
    ++num_refused_;
    error_ = error.what();
  }
}

Json LiveLinkReceiver::Describe() const {
  const std::scoped_lock lock(mutex_);
  return {{"address", place_.address},
          {"port", place_.port},
          {"packets", num_packets_},
          {"without_face", num_without_face_},
          {"refused", num_refused_},
          {"subject", subject_},
          {"error", error_}};
}

}  // namespace daumier::studio
