#pragma once
#include "core/error.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <string_view>

namespace daumier::testing {

/// Sends UDP packets to a port of 127.0.0.1.
class UdpSender {
 public:
  explicit UdpSender(int port) : socket_(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(static_cast<uint16_t>(port));
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    DAUMIER_CHECK(connect(socket_, reinterpret_cast<const sockaddr*>(&to), sizeof to) == 0, "no socket");
  }
  ~UdpSender() { close(socket_); }
  UdpSender(const UdpSender&) = delete;
  UdpSender& operator=(const UdpSender&) = delete;

  void Send(std::string_view packet) const {
    DAUMIER_CHECK(send(socket_, packet.data(), packet.size(), 0) == ssize_t(packet.size()), "a packet was not sent");
  }

 private:
  int socket_;
};

}  // namespace daumier::testing
