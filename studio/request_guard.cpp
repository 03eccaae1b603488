#include "studio/request_guard.h"

#include "core/error.h"

#include <fmt/format.h>
#include <sys/random.h>

#include <array>

namespace daumier::studio {
namespace {

bool IsOwnHost(std::string_view host, int port) {
  for (const std::string_view name : {"127.0.0.1", "localhost"})
    if (host == fmt::format("{}:{}", name, port)) return true;
  return false;
}

bool IsOwnOrigin(std::string_view origin, int port) {
  constexpr std::string_view kScheme = "http://";
  return origin.starts_with(kScheme) && IsOwnHost(origin.substr(kScheme.size()), port);
}

}  // namespace

std::optional<Refusal> RefusalOf(const RequestHeaders& headers, std::string_view path, int port,
                                 std::string_view token) {
  if (!IsOwnHost(headers.host, port))
    return Refusal{403, fmt::format("this server is 127.0.0.1:{} and nothing else", port)};
  if (!headers.origin.empty() && !IsOwnOrigin(headers.origin, port))
    return Refusal{403, "requests of other pages are refused"};
  if (!path.starts_with("/api/")) return std::nullopt;
  constexpr std::string_view kBearer = "Bearer ";
  const std::string_view authorization = headers.authorization;
  if (!authorization.starts_with(kBearer) || !EqualInConstantTime(authorization.substr(kBearer.size()), token))
    return Refusal{401, "the token is not that of this start. Open the address that `daumier studio` printed"};
  return std::nullopt;
}

std::string RandomToken() {
  std::array<unsigned char, 16> bytes;
  DAUMIER_CHECK(getrandom(bytes.data(), bytes.size(), 0) == ssize_t(bytes.size()),
                "the system has no random numbers for the studio's token");
  std::string token;
  for (const unsigned char byte : bytes) token += fmt::format("{:02x}", byte);
  return token;
}

bool EqualInConstantTime(std::string_view first, std::string_view second) {
  if (first.size() != second.size()) return false;
  unsigned char difference = 0;
  for (size_t i = 0; i < first.size(); ++i) difference |= static_cast<unsigned char>(first[i] ^ second[i]);
  return difference == 0;
}

}  // namespace daumier::studio
