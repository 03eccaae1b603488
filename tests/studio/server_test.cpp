#include "studio/server.h"

#include "tests/studio/shipped_studio.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>
#include <httplib.h>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <chrono>
#include <future>
#include <thread>

namespace daumier::studio {
namespace {

using testing::ExpectError;

/// A served studio. A test ends it as a program does, by the stop of a token.
class ServerTest : public ::testing::Test {
 protected:
  ServerTest() {
    thread_ = std::thread([this] { server_.Serve(stop_.get_token()); });
    httplib::Client client = NewClient();
    EXPECT_TRUE(client.Get("/")) << "it serves";
  }
  ~ServerTest() override { Stop(); }
  void Stop() {
    stop_.request_stop();
    if (thread_.joinable()) thread_.join();
  }

  httplib::Client NewClient() const {
    httplib::Client client("127.0.0.1", server_.port());
    client.set_connection_timeout(5);
    client.set_read_timeout(20);
    client.set_write_timeout(20);
    client.set_tcp_nodelay(true);
    return client;
  }
  /// The headers of a call, and others.
  httplib::Headers Token(httplib::Headers others = {}) const {
    others.emplace("Authorization", "Bearer " + server_.token());
    return others;
  }
  std::string Host(const std::string& name = "127.0.0.1") const { return name + ":" + std::to_string(server_.port()); }
  int Status(const httplib::Result& result) const {
    EXPECT_TRUE(result) << httplib::to_string(result.error());
    return result ? result->status : -1;
  }
  int GetStatus(const std::string& path, const httplib::Headers& headers) const {
    return Status(NewClient().Get(path, headers));
  }
  int PostStatus(const std::string& path, const std::string& body) const {
    return Status(NewClient().Post(path, Token(), body, "application/json"));
  }

  Server server_{testing::ShippedStudio::Get().studio(), 0};
  std::stop_source stop_;
  std::thread thread_;
};

/// Bytes that come on a connection within a moment; empty if it was closed.
std::string Received(int connection) {
  const timeval moment{.tv_sec = 0, .tv_usec = 400'000};
  setsockopt(connection, SOL_SOCKET, SO_RCVTIMEO, &moment, sizeof moment);
  std::string bytes;
  char buffer[4096];
  for (ssize_t count; (count = recv(connection, buffer, sizeof buffer, 0)) > 0;) bytes.append(buffer, size_t(count));
  return bytes;
}

int ConnectedTo(int port) {
  const int connection = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(uint16_t(port));
  inet_pton(AF_INET, "127.0.0.1", &address.sin_addr);
  EXPECT_EQ(connect(connection, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  return connection;
}

void SendText(int connection, const std::string& text) {
  EXPECT_EQ(send(connection, text.data(), text.size(), MSG_NOSIGNAL), ssize_t(text.size()));
}

TEST_F(ServerTest, ItsAddressHasThePortAndTheToken) {
  EXPECT_GT(server_.port(), 0);
  EXPECT_EQ(server_.token().size(), 32u);
  EXPECT_EQ(server_.Address(), "http://" + Host() + "/#token=" + server_.token());
}

TEST_F(ServerTest, TheApiNeedsTheTokenAndThePageDoesNot) {
  EXPECT_EQ(GetStatus("/api/info", Token()), 200);
  EXPECT_EQ(GetStatus("/api/info", {}), 401);
  EXPECT_EQ(GetStatus("/api/info?token=" + server_.token(), {}), 401);
  EXPECT_EQ(GetStatus("/api/info", {{"Authorization", "Bearer 00000000000000000000000000000000"}}), 401);
  EXPECT_EQ(GetStatus("/%61pi/info", {}), 401) << "an encoded path is the same path";
  EXPECT_EQ(GetStatus("/%61pi/info", Token()), 200);
  EXPECT_NE(GetStatus("//api/info", {}), 200);
  EXPECT_NE(GetStatus("/./api/info", {}), 200);
  EXPECT_NE(GetStatus("/page.js/../api/info", {}), 200);
  EXPECT_EQ(GetStatus("/", {}), HasPage() ? 200 : 404);
  const auto refused = NewClient().Get("/api/info");
  ASSERT_TRUE(refused);
  EXPECT_FALSE(Json::parse(refused->body)["error"].get<std::string>().empty());
}

TEST_F(ServerTest, ContentIsNotCompressed) {
  for (const char* path : {"/api/openapi.json", "/api/shape", "/", "/page.js", "/page.css"}) {
    if (!HasPage() && !std::string_view(path).starts_with("/api/")) continue;
    const auto plain = NewClient().Get(path, Token({{"Accept-Encoding", "identity"}}));
    const auto browser = NewClient().Get(path, Token({{"Accept-Encoding", "gzip, deflate, br, zstd"}}));
    ASSERT_EQ(Status(browser), 200) << path;
    EXPECT_FALSE(browser->has_header("Content-Encoding")) << path;
    EXPECT_EQ(browser->get_header_value("Content-Length"), std::to_string(browser->body.size())) << path;
    EXPECT_EQ(browser->body, plain->body) << path;
  }
}

TEST_F(ServerTest, OtherHostsAndOriginsAreRefused) {
  for (const char* path : {"/api/info", "/", "/page.js"}) {
    EXPECT_EQ(GetStatus(path, Token({{"Host", "evil.example:" + std::to_string(server_.port())}})), 403) << path;
    EXPECT_EQ(GetStatus(path, Token({{"Host", "127.0.0.1"}})), 403) << path;
    EXPECT_EQ(GetStatus(path, Token({{"Origin", "http://evil.example"}})), 403) << path;
    EXPECT_EQ(GetStatus(path, Token({{"Origin", "null"}})), 403) << path;
  }
  EXPECT_EQ(GetStatus("/api/info", Token({{"Host", Host("localhost")}})), 200);
  EXPECT_EQ(GetStatus("/api/info", Token({{"Origin", "http://" + Host()}})), 200);
  EXPECT_EQ(GetStatus("/api/info", Token({{"Origin", "http://" + Host("localhost")}})), 200);
  const size_t before = Json::parse(NewClient().Get("/api/sessions", Token())->body)["sessions"].size();
  EXPECT_EQ(Status(NewClient().Post("/api/sessions", Token({{"Origin", "http://evil.example"}}), "{}", "text/plain")),
            403);
  EXPECT_EQ(Json::parse(NewClient().Get("/api/sessions", Token())->body)["sessions"].size(), before);
}

TEST_F(ServerTest, TheBodyOfARefusedRequestIsNoRequest) {
  const int connection = ConnectedTo(server_.port());
  const std::string inner = "GET /page.css HTTP/1.1\r\nHost: " + Host() + "\r\n\r\n";
  SendText(connection, "POST /api/sessions HTTP/1.1\r\nHost: " + Host() +
                           "\r\nOrigin: http://evil.example\r\nContent-Length: " + std::to_string(inner.size()) +
                           "\r\n\r\n");
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  send(connection, inner.data(), inner.size(), MSG_NOSIGNAL);  // The connection may be closed.
  const std::string replies = Received(connection);
  EXPECT_TRUE(replies.starts_with("HTTP/1.1 403")) << replies.substr(0, 200);
  EXPECT_EQ(replies.find("HTTP/1.1 ", 1), std::string::npos) << "two replies to one request";
  close(connection);
}

TEST_F(ServerTest, AConnectionContinuesAfterARefusal) {
  httplib::Client client = NewClient();
  client.set_keep_alive(true);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(Status(client.Post("/api/sessions", std::string(100'000, ' '), "application/json")), 401);
    EXPECT_EQ(Status(client.Get("/api/info", Token())), 200);
  }
}

TEST_F(ServerTest, EachReplyForbidsWhatThePageDoesNotNeed) {
  for (const char* path : {"/", "/page.js", "/page.css", "/api/info", "/nothing"}) {
    const auto result = NewClient().Get(path, Token());
    ASSERT_TRUE(result);
    const std::string policy = result->get_header_value("Content-Security-Policy");
    EXPECT_TRUE(policy.starts_with("default-src 'self';")) << path;
    EXPECT_NE(policy.find("frame-ancestors 'none'"), std::string::npos) << path;
    EXPECT_EQ(policy.find("unsafe-eval"), std::string::npos) << path;
    EXPECT_EQ(result->get_header_value("X-Content-Type-Options"), "nosniff") << path;
    EXPECT_EQ(result->get_header_value("Cache-Control"), "no-store") << path;
    EXPECT_EQ(result->get_header_value("Referrer-Policy"), "no-referrer") << path;
    EXPECT_EQ(result->get_header_value("Cross-Origin-Resource-Policy"), "same-origin") << path;
    EXPECT_FALSE(result->has_header("Access-Control-Allow-Origin")) << path;
  }
}

TEST_F(ServerTest, ThePageIsInTheProgram) {
  const std::pair<const char*, const char*> files[] = {
      {"/", "text/html"}, {"/page.js", "text/javascript"}, {"/page.css", "text/css"}};
  for (const auto& [path, type] : files) {
    const auto result = NewClient().Get(path);
    ASSERT_TRUE(result);
    if (!HasPage()) {
      EXPECT_EQ(result->status, 404);
      EXPECT_NE(result->body.find("without its page"), std::string::npos);
      continue;
    }
    EXPECT_EQ(result->status, 200) << path;
    EXPECT_TRUE(result->get_header_value("Content-Type").starts_with(type)) << path;
    EXPECT_FALSE(result->body.empty()) << path;
    EXPECT_EQ(result->body.find("https://fonts."), std::string::npos) << "it needs no other site";
  }
}

TEST_F(ServerTest, UnknownPathsAndMethodsAreErrorsInJson) {
  const auto error = [](const httplib::Result& result) {
    return Json::parse(result->body)["error"].get<std::string>();
  };
  for (const char* path : {"/api/nothing", "/nothing", "/index.html", "/../weights", "/api/", "/api/sessions/"}) {
    const auto result = NewClient().Get(path, Token());
    ASSERT_TRUE(result) << path;
    EXPECT_EQ(result->status, 404) << path;
    EXPECT_FALSE(error(result).empty()) << path;
  }
  const auto result = NewClient().Delete("/api/info", Token());
  ASSERT_TRUE(result);
  EXPECT_EQ(result->status, 405);
  EXPECT_EQ(error(result), "DELETE is no method of /api/info");
  EXPECT_EQ(Status(NewClient().Put("/api/info", Token(), "{}", "application/json")), 405);
}

TEST_F(ServerTest, PathsThatLeaveAFolderAreNotFound) {
  for (const char* path :
       {"/api/uploads/..%2F..%2Fsessions%2Fs-0007%2Fabout.json", "/api/uploads/%2e%2e",
        "/api/sessions/s-0007%2F..%2Fs-0007", "/api/sessions/..%2Fsessions%2Fs-0007", "/api/faces/..%5C/vertices",
        "/api/jobs/j-0001/files/..%2F..%2Fsessions%2Fs-0007%2Fabout.json", "/api/uploads/u-0001%00"})
    EXPECT_EQ(GetStatus(path, Token()), 404) << path;
}

TEST_F(ServerTest, BodiesAndQueriesArrive) {
  const std::string bytes("a\0\r\n\xff", 5);
  const auto upload =
      NewClient().Post("/api/uploads?name=..%2Fmy%20take.bin", Token(), bytes, "application/octet-stream");
  ASSERT_EQ(Status(upload), 200);
  const Json json = Json::parse(upload->body);
  EXPECT_EQ(json["name"], "my_take.bin");
  const auto back = NewClient().Get("/api/uploads/" + json["id"].get<std::string>(), Token());
  ASSERT_EQ(Status(back), 200);
  EXPECT_EQ(back->body, bytes);
  EXPECT_EQ(back->get_header_value("Content-Type"), "application/octet-stream");
  const auto begun = NewClient().Post("/api/sessions", Token(), R"({"name": "Zoë"})", "application/json");
  ASSERT_EQ(Status(begun), 200);
  const std::string path = "/api/sessions/" + Json::parse(begun->body)["id"].get<std::string>();
  EXPECT_EQ(Json::parse(begun->body)["name"], "Zoë");
  const auto none = NewClient().Get(path + "/vertices", Token());
  EXPECT_EQ(Status(none), 204);
  EXPECT_EQ(none->body, "");
  EXPECT_EQ(Status(NewClient().Patch(path, Token(), R"({"name": "x"})", "application/json")), 200);
  EXPECT_EQ(Status(NewClient().Delete(path, Token())), 200);
  EXPECT_EQ(GetStatus(path, Token()), 404);
  for (const char* body : {"", "{", "[]", "name=x"}) EXPECT_EQ(PostStatus("/api/sessions", body), 400) << body;
}

TEST_F(ServerTest, LargeBodiesAreRefused) {
  const std::string above_body(Server::kMostBody + 1, ' ');
  EXPECT_EQ(PostStatus("/api/shape", above_body), 413);
  EXPECT_EQ(PostStatus("/api/sessions", above_body), 413);
  const auto upload = NewClient().Post("/api/uploads?name=a.bin", Token(), above_body, "application/octet-stream");
  EXPECT_EQ(Status(upload), 200) << "an upload may be larger";
  const std::string above_upload(Server::kMostUpload + 1, ' ');
  EXPECT_EQ(Status(NewClient().Post("/api/uploads?name=a.bin", Token(), above_upload, "application/octet-stream")),
            413);
}

TEST_F(ServerTest, ACompressedBodyIsRefused) {
  httplib::Client client = NewClient();
  client.set_compress(true);
  const std::string above_upload(Server::kMostUpload + 1, ' ');
  EXPECT_EQ(Status(client.Post("/api/uploads?name=a.bin", Token(), above_upload, "application/octet-stream")), 415);
}

TEST_F(ServerTest, RequestsComeAtOnce) {
  const auto draw = [this](int number) {
    httplib::Client client = NewClient();
    client.set_keep_alive(true);
    const auto begun = client.Post("/api/sessions", Token(), R"({"begin": "mean"})", "application/json");
    const std::string path = "/api/sessions/" + Json::parse(begun->body)["id"].get<std::string>();
    for (int i = 0; i < 3; ++i) {
      const Json event = {{"do", "draw"}, {"points", {{5 + 9 * i, 5 + number}, {11 + 9 * i, 5 + number}}}};
      EXPECT_EQ(Status(client.Post(path + "/events", Token(), event.dump(), "application/json")), 200);
    }
    return Json::parse(client.Get(path, Token())->body)["revision"].get<int>();
  };
  auto first = std::async(std::launch::async, draw, 0), second = std::async(std::launch::async, draw, 1);
  EXPECT_EQ(first.get(), 3);
  EXPECT_EQ(second.get(), 3);
}

TEST_F(ServerTest, AnotherServerCannotTakeItsPort) {
  Studio& studio = testing::ShippedStudio::Get().studio();
  ExpectError([&] { Server(studio, server_.port()); }, "port " + std::to_string(server_.port()) + " is taken");
  EXPECT_THROW(Server(studio, server_.port()), UsageError);
  EXPECT_EQ(GetStatus("/api/info", Token()), 200) << "the first one serves on";
  const Server other(studio, 0);
  EXPECT_NE(other.port(), server_.port());
  EXPECT_NE(other.token(), server_.token());
}

TEST_F(ServerTest, ListensOnThisMachineAlone) {
  httplib::Client client("127.0.0.2", server_.port());
  client.set_connection_timeout(2);
  EXPECT_FALSE(client.Get("/"));
}

TEST_F(ServerTest, EndsByItsStopThoughAConnectionIsOpen) {
  httplib::Client client = NewClient();
  client.set_keep_alive(true);
  EXPECT_EQ(Status(client.Get("/api/info", Token())), 200);
  const auto begin = std::chrono::steady_clock::now();
  Stop();
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(5));
  EXPECT_FALSE(NewClient().Get("/"));
}

TEST(Server, EndsByAStopThatCameBeforeItServes) {
  // Kept by its thread: a server that does not end cannot be waited for.
  const auto server = std::make_shared<Server>(testing::ShippedStudio::Get().studio(), 0);
  std::stop_source stop;
  stop.request_stop();
  const auto has_ended = std::make_shared<std::promise<void>>();
  std::thread([server, has_ended, token = stop.get_token()] {
    server->Serve(token);
    has_ended->set_value();
  }).detach();
  EXPECT_EQ(has_ended->get_future().wait_for(std::chrono::seconds(3)), std::future_status::ready);
}

}  // namespace
}  // namespace daumier::studio
