#pragma once
#include "studio/studio.h"

#include <functional>
#include <memory>
#include <stop_token>
#include <string>

namespace daumier::studio {

/// The studio on 127.0.0.1 alone: its page, which is embedded in the program, and its API. Requests are judged by RefusalOf; bodies
/// of more than kMostUpload bytes are refused, of anything but uploads those of more than kMostBody.
class Server {
 public:
  static constexpr size_t kMostUpload = 64 << 20, kMostBody = 8 << 20;

  /// port: 0 takes a free one. The studio has to outlive the server. @throws UsageError if another program has the port.
  Server(Studio& studio, int port) : Server(studio.routes(), port) {}
  /// The page in another mode: GET /api/info of the routes names it. They have to outlive the server.
  Server(const std::vector<Route>& routes, int port);
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  int port() const { return port_; }
  const std::string& token() const { return token_; }
  /// http://127.0.0.1:PORT/#token=TOKEN
  std::string Address() const;
  /// Until the token's stop is requested.
  void Serve(std::stop_token stop);

 private:
  struct Connection;  ///< The library's server.
  void AddPage();
  void AddApi(const std::vector<Route>& routes);

  int port_ = 0;
  std::string token_;
  std::unique_ptr<Connection> connection_;
};

/// Whether the page is in the program: it is bundled by npm's packages, and left out where these are not installed.
bool HasPage();

}  // namespace daumier::studio
