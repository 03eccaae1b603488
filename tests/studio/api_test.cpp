#include "studio/api.h"

#include "core/task.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace daumier::studio {
namespace {

using testing::ExpectError;

/// A route whose reply is what it was called with.
Route EchoRoute(std::string method, std::string path) {
  return {std::move(method), std::move(path), "echoes", [](const ApiRequest& request) {
            return JsonReply({{"path", request.path}, {"query", request.query}, {"body", std::string(request.body)}});
          }};
}

template <class Failure>
ApiReply ReplyToFailure(const Failure& failure) {
  const std::vector<Route> routes = {{"GET", "/api/a", "fails", [&](const ApiRequest&) -> ApiReply { throw failure; }}};
  return Call(routes, "GET", "/api/a", {});
}

Json CallJson(const std::vector<Route>& routes, std::string_view method, std::string_view path) {
  return Json::parse(Call(routes, method, path, {}).body);
}

TEST(Api, ABodyIsAnObject) {
  EXPECT_EQ(BodyOf({.path = {}, .query = {}, .body = R"({"a": 1})"}), (Json{{"a", 1}}));
  for (const char* body : {"", "[]", "3", "{", "{\"a\": \"\xff\"}", "{} {}"})
    EXPECT_THROW(BodyOf({.path = {}, .query = {}, .body = body}), UsageError) << body;
  ExpectError([] { BodyOf({.path = {}, .query = {}, .body = std::string(300, '[')}); }, "the body is no JSON object");
}

TEST(Api, ANumberOfTheQueryIsFiniteOrTheDefault) {
  const auto number = [](const char* text) { return NumberIn({.path = {}, .query = {{"yaw", text}}}, "yaw", 7); };
  EXPECT_EQ(NumberIn({}, "yaw", 7), 7);
  EXPECT_EQ(number("-12.5"), -12.5);
  EXPECT_EQ(number("1e2"), 100);
  for (const char* text : {"", "a", "1 ", " 1", "1x", "nan", "inf", "1e999", "--1"})
    EXPECT_THROW(number(text), UsageError) << "'" << text << "'";
  ExpectError([&] { number("wide"); }, "'yaw' is wide, expected a number");
}

TEST(Api, VariablesOfAPathAreItsParts) {
  const std::vector<Route> routes = {EchoRoute("GET", "/api/a/{id}"), EchoRoute("GET", "/api/a/{id}/b"),
                                     EchoRoute("GET", "/api/a/{id}/files/{name...}")};
  EXPECT_EQ(CallJson(routes, "GET", "/api/a/s-1")["path"], (Json{{"id", "s-1"}}));
  EXPECT_EQ(CallJson(routes, "GET", "/api/a/../b")["path"], (Json{{"id", ".."}}));
  EXPECT_EQ(CallJson(routes, "GET", "/api/a/j/files/stages/1.png")["path"],
            (Json{{"id", "j"}, {"name", "stages/1.png"}}));
  EXPECT_EQ(CallJson(routes, "GET", "/api/a/j/files/../../x")["path"]["name"], "../../x") << "its user refuses it";
  for (const char* path : {"", "/", "/api", "/api/a", "/api/a/1/b/c", "/api/b/1", "/api/a/1/", "api/a/1", "/API/a/1"})
    EXPECT_EQ(Call(routes, "GET", path, {}).status, 404) << path;
}

TEST(Api, PassesTheQueryAndTheBodyOn) {
  const Json json = Json::parse(
      Call({EchoRoute("POST", "/api/a")}, "POST", "/api/a", {.path = {}, .query = {{"q", "1"}}, .body = "text"}).body);
  EXPECT_EQ(json["query"], (Json{{"q", "1"}}));
  EXPECT_EQ(json["body"], "text");
}

TEST(Api, AnotherMethodOfAPathIs405) {
  const std::vector<Route> routes = {EchoRoute("GET", "/api/a"), EchoRoute("POST", "/api/a")};
  EXPECT_EQ(Call(routes, "POST", "/api/a", {}).status, 200);
  const ApiReply reply = Call(routes, "DELETE", "/api/a", {});
  EXPECT_EQ(reply.status, 405);
  EXPECT_EQ(Json::parse(reply.body)["error"], "DELETE is no method of /api/a");
  EXPECT_EQ(Json::parse(Call(routes, "GET", "/api/b", {}).body)["error"], "there is no /api/b");
}

TEST(Api, ErrorsAreRepliesByTheirKind) {
  EXPECT_EQ(ReplyToFailure(NotFound("gone")).status, 404);
  EXPECT_EQ(ReplyToFailure(Cancelled("stopped")).status, 409);
  EXPECT_EQ(ReplyToFailure(UsageError("wrong")).status, 400);
  EXPECT_EQ(ReplyToFailure(Error("wrong")).status, 400);
  EXPECT_EQ(ReplyToFailure(std::out_of_range("map::at")).status, 500);
  const ApiReply reply = ReplyToFailure(Error("wrong"));
  EXPECT_EQ(reply.type, "application/json");
  EXPECT_EQ(Json::parse(reply.body), (Json{{"error", "wrong"}}));
}

TEST(Api, AReplyIsUtf8WhateverAnErrorQuotes) {
  const ApiReply reply = ReplyToFailure(Error("'\xC3' is no name"));
  EXPECT_EQ(Json::parse(reply.body)["error"], "'\xEF\xBF\xBD' is no name");
}

TEST(Api, BytesAreSentAsTheyAre) {
  const ApiReply reply = BinaryReply(std::string("a\0b", 3));
  EXPECT_EQ(reply.status, 200);
  EXPECT_EQ(reply.type, "application/octet-stream");
  EXPECT_EQ(reply.body, std::string("a\0b", 3));
}

TEST(Api, IsDescribedRouteByRoute) {
  Route post = EchoRoute("POST", "/api/a/{id}");
  post.body = {{"type", "object"}};
  post.reply = "image/png";
  const Json json = OpenApiOf({EchoRoute("GET", "/api/a/{id}"), post});
  EXPECT_EQ(json["openapi"], "3.1.0");
  const Json& path = json["paths"]["/api/a/{id}"];
  EXPECT_EQ(path["get"]["summary"], "echoes");
  EXPECT_FALSE(path["get"].contains("requestBody"));
  EXPECT_EQ(path["get"]["parameters"][0]["name"], "id");
  EXPECT_EQ(path["post"]["requestBody"]["content"]["application/json"]["schema"]["type"], "object");
  EXPECT_TRUE(path["post"]["responses"]["200"]["content"].contains("image/png"));
}

TEST(Api, EachVariableOfADescribedPathIsAParameterOfThatName) {
  const Json json = OpenApiOf({EchoRoute("GET", "/api/a/{id}/files/{name...}")});
  const std::string path = json["paths"].begin().key();
  for (const Json& parameter : json["paths"][path]["get"]["parameters"])
    EXPECT_NE(path.find("{" + parameter["name"].get<std::string>() + "}"), std::string::npos) << parameter << path;
}

}  // namespace
}  // namespace daumier::studio
