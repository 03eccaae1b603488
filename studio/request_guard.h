#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace daumier::studio {

/// The headers by which a request is judged; empty where it has none.
struct RequestHeaders {
  std::string host, origin, authorization;
};

struct Refusal {
  int status;
  std::string sentence;
};

/// Why a request is refused, or nothing. Host has to be 127.0.0.1 or localhost with the server's port, so that a name which another
/// site's DNS points at this machine is none of them; Origin, if there is one, that of the page, so that other pages cannot post;
/// and a call of the API has to have the token of this start, which only who was given the page's address has.
std::optional<Refusal> RefusalOf(const RequestHeaders& headers, std::string_view path, int port,
                                 std::string_view token);

/// 32 hexadecimal digits of the system's random numbers. @throws Error if there are none.
std::string RandomToken();

/// Whether both texts are equal, in a time that depends on the lengths alone.
bool EqualInConstantTime(std::string_view first, std::string_view second);

}  // namespace daumier::studio
