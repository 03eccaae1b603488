#include "studio/server.h"

#include "core/error.h"
#include "embedded/studio_page.h"
#include "studio/request_guard.h"

#include <fmt/format.h>
#include <httplib.h>
#include <sys/socket.h>

#include <chrono>
#include <thread>
#include <utility>

namespace daumier::studio {
namespace {

constexpr char kAddress[] = "127.0.0.1";
constexpr size_t kThreads = 16;
/// A refused request is not read to its end: what is left of it must not be taken for another one.
constexpr size_t kRequestsOfConnection = 1;

constexpr std::chrono::milliseconds kPause(20);

/// The page needs nothing from elsewhere, and no other page may hold it in a frame.
constexpr char kPolicy[] =
    "default-src 'self'; img-src 'self' blob: data:; style-src 'self' 'unsafe-inline'; connect-src 'self' blob:; "
    "worker-src 'self' blob:; frame-ancestors 'none'; base-uri 'none'; form-action 'none'";

struct PageFile {
  const char *path, *stem, *type;
};
constexpr PageFile kPageFiles[] = {{"/", "index", "text/html; charset=utf-8"},
                                   {"/page.js", "page", "text/javascript; charset=utf-8"},
                                   {"/page.css", "style", "text/css; charset=utf-8"}};

/// The library lets two servers share a port: requests would reach either.
void TakePortAlone(socket_t socket) {
  const int yes = 1;
  setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
}

void SetHeaders(httplib::Response& response) {
  response.set_header("Cache-Control", "no-store");
  response.set_header("X-Content-Type-Options", "nosniff");
  response.set_header("Referrer-Policy", "no-referrer");
  response.set_header("Cross-Origin-Resource-Policy", "same-origin");
  response.set_header("Content-Security-Policy", kPolicy);
}

/// The library compresses texts that it has as a whole, by brotli at its slowest: seconds for the page, and longer than the
/// connection within a machine takes for anything. It sends pieces of a given length as they are.
template <class Bytes>
void SetUncompressed(Bytes bytes, const std::string& type, httplib::Response& response) {
  const size_t size = bytes.size();
  response.set_content_provider(size, type,
                                [bytes = std::move(bytes)](size_t offset, size_t length, httplib::DataSink& sink) {
                                  return sink.write(bytes.data() + offset, length);
                                });
}

void SetReply(const ApiReply& reply, httplib::Response& response) {
  response.status = reply.status;
  if (reply.status == 204) return;
  // The error handler sees the sentence of an error.
  if (reply.status >= 400 || reply.body.empty())
    response.set_content(reply.body, reply.type);
  else
    SetUncompressed(reply.body, reply.type, response);
}

ApiReply Refused(int status, const std::string& sentence) {
  ApiReply reply = JsonReply({{"error", sentence}});
  reply.status = status;
  return reply;
}

/// A request without its body.
ApiRequest QueryOf(const httplib::Request& request) {
  ApiRequest made;
  for (const auto& [name, value] : request.params) made.query.emplace(name, value);
  return made;
}

}  // namespace

struct Server::Connection {
  httplib::Server http;
};

bool HasPage() {
  return EmbeddedFiles().contains(kPageFiles[0].stem);
}

Server::Server(const std::vector<Route>& routes, int port)
    : token_(RandomToken()), connection_(std::make_unique<Connection>()) {
  httplib::Server& http = connection_->http;
  http.new_task_queue = [] { return new httplib::ThreadPool(kThreads); };
  http.set_socket_options(TakePortAlone);
  http.set_tcp_nodelay(true);
  http.set_keep_alive_max_count(kRequestsOfConnection);
  http.set_payload_max_length(kMostUpload);
  http.set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
    SetHeaders(response);
    const RequestHeaders headers{request.get_header_value("Host"), request.get_header_value("Origin"),
                                 request.get_header_value("Authorization")};
    std::optional<Refusal> refusal = RefusalOf(headers, request.path, port_, token_);
    if (!refusal && request.has_header("Content-Encoding"))  // Its size would be known after it is unpacked.
      refusal = {415, "packed requests are refused"};
    if (!refusal) return httplib::Server::HandlerResponse::Unhandled;
    SetReply(Refused(refusal->status, refusal->sentence), response);
    return httplib::Server::HandlerResponse::Handled;
  });
  http.set_error_handler([](const httplib::Request&, httplib::Response& response) {
    if (response.body.empty())
      SetReply(Refused(response.status, response.status == 413 ? "the file is too large" : "there is no such page"),
               response);
  });
  AddPage();
  AddApi(routes);
  port_ = port == 0 ? http.bind_to_any_port(kAddress) : http.bind_to_port(kAddress, port) ? port : -1;
  if (port_ <= 0)
    throw UsageError(fmt::format("port {} is taken by another program. Name another one with --port, or none", port));
}

Server::~Server() = default;

std::string Server::Address() const {
  return fmt::format("http://{}:{}/#token={}", kAddress, port_, token_);
}

void Server::AddPage() {
  for (const PageFile& file : kPageFiles)
    connection_->http.Get(file.path, [&file](const httplib::Request&, httplib::Response& response) {
      const auto found = EmbeddedFiles().find(file.stem);
      if (found == EmbeddedFiles().end())
        return SetReply(Refused(404, "this program was built without its page"), response);
      SetUncompressed(found->second, file.type, response);
    });
}

void Server::AddApi(const std::vector<Route>& routes) {
  const auto call = [&routes](const httplib::Request& request, httplib::Response& response) {
    const bool is_upload = request.path == "/api/uploads";
    if (!is_upload && request.body.size() > kMostBody)
      return SetReply(Refused(413, "the request is too large"), response);
    ApiRequest made = QueryOf(request);
    made.body = request.body;
    SetReply(Call(routes, request.method, request.path, std::move(made)), response);
  };
  constexpr char kApi[] = "/api/.*";
  connection_->http.Get(kApi, call);
  connection_->http.Post(kApi, call);
  connection_->http.Put(kApi, call);
  connection_->http.Patch(kApi, call);
  connection_->http.Delete(kApi, call);
}

void Server::Serve(std::stop_token stop) {
  httplib::Server& http = connection_->http;
  const std::jthread stopper([&http, stop](std::stop_token served) {
    while (!stop.stop_requested() && !served.stop_requested()) std::this_thread::sleep_for(kPause);
    while (!http.is_running() && !served.stop_requested())
      std::this_thread::sleep_for(kPause);  // A stop before has no effect.
    http.stop();
  });
  http.listen_after_bind();
}

}  // namespace daumier::studio
