#include "studio/request_guard.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

namespace daumier::studio {
namespace {

constexpr int kGuardPort = 8123;
constexpr char kGuardToken[] = "0123456789abcdef0123456789abcdef";

/// The status by which a request is refused; 0: it is not.
int RefusedBy(const RequestHeaders& headers, std::string_view path = "/api/info") {
  const auto refusal = RefusalOf(headers, path, kGuardPort, kGuardToken);
  if (!refusal) return 0;
  EXPECT_FALSE(refusal->sentence.empty());
  return refusal->status;
}

RequestHeaders GoodHeaders() {
  return {.host = "127.0.0.1:8123", .origin = "", .authorization = std::string("Bearer ") + kGuardToken};
}

TEST(RequestGuard, AcceptsThePageAndPrograms) {
  RequestHeaders headers = GoodHeaders();
  EXPECT_EQ(RefusedBy(headers), 0) << "a program sends no Origin";
  for (const char* origin : {"http://127.0.0.1:8123", "http://localhost:8123"}) {
    headers.origin = origin;
    EXPECT_EQ(RefusedBy(headers), 0) << origin;
  }
  headers.host = "localhost:8123";
  EXPECT_EQ(RefusedBy(headers), 0);
}

TEST(RequestGuard, RefusesOtherHosts) {
  for (const char* host :
       {"", "evil.example", "evil.example:8123", "127.0.0.1", "127.0.0.1:8124", "localhost", "localhost:80",
        "127.0.0.1:8123.evil.example", "127.0.0.1.evil.example:8123", "localhost.evil.example:8123",
        "evil@127.0.0.1:8123", "127.0.0.2:8123", "0.0.0.0:8123", "[::1]:8123", " 127.0.0.1:8123"}) {
    RequestHeaders headers = GoodHeaders();
    headers.host = host;
    EXPECT_EQ(RefusedBy(headers), 403) << host;
    EXPECT_EQ(RefusedBy(headers, "/"), 403) << "the page, too: " << host;
  }
}

TEST(RequestGuard, RefusesOtherOrigins) {
  for (const char* origin :
       {"null", "http://evil.example", "https://127.0.0.1:8123", "http://127.0.0.1", "http://127.0.0.1:80",
        "http://localhost:3000", "http://127.0.0.1:8123.evil.example", "http://127.0.0.1:8123/", "127.0.0.1:8123",
        "http://evil.example#http://127.0.0.1:8123", "file://"}) {
    RequestHeaders headers = GoodHeaders();
    headers.origin = origin;
    EXPECT_EQ(RefusedBy(headers), 403) << origin;
    EXPECT_EQ(RefusedBy(headers, "/page.js"), 403) << origin;
  }
}

TEST(RequestGuard, RefusesCallsWithoutTheTokenOfThisStart) {
  const std::string token = kGuardToken;
  const std::vector<std::string> wrong = {"",
                                          token,
                                          "Bearer",
                                          "Bearer ",
                                          "bearer " + token,
                                          "Basic " + token,
                                          "Bearer " + token.substr(1),
                                          "Bearer " + token + "0",
                                          "Bearer  " + token,
                                          "Bearer " + std::string(32, '0'),
                                          "Bearer 0123456789ABCDEF0123456789ABCDEF"};
  for (const std::string& authorization : wrong) {
    RequestHeaders headers = GoodHeaders();
    headers.authorization = authorization;
    EXPECT_EQ(RefusedBy(headers), 401) << authorization;
    EXPECT_EQ(RefusedBy(headers, "/"), 0) << "the page has nothing to hide, and reads the token from its address";
  }
}

TEST(RequestGuard, TokensAre32DigitsAndDifferent) {
  std::set<std::string> tokens;
  for (int i = 0; i < 100; ++i) {
    const std::string token = RandomToken();
    EXPECT_EQ(token.size(), 32u);
    EXPECT_TRUE(std::ranges::all_of(token, [](char c) { return std::string_view("0123456789abcdef").find(c) < 16; }))
        << token;
    tokens.insert(token);
  }
  EXPECT_EQ(tokens.size(), 100u);
}

TEST(RequestGuard, ComparesWholeTexts) {
  EXPECT_TRUE(EqualInConstantTime("", ""));
  EXPECT_TRUE(EqualInConstantTime("abc", "abc"));
  for (const char* other : {"", "ab", "abcd", "abd", "xbc", "ABC"}) EXPECT_FALSE(EqualInConstantTime("abc", other));
  EXPECT_FALSE(EqualInConstantTime(std::string_view("a\0b", 3), std::string_view("a\0c", 3)));
}

}  // namespace
}  // namespace daumier::studio
