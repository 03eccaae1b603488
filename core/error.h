#pragma once
#include <fmt/format.h>

#include <stdexcept>
#include <string>

/// core/ is the one room that lives in the namespace `daumier` itself: every other room speaks its words.
namespace daumier {

/// The one exception type of this project: what was expected, what was found, where, and what to do about it.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A command or a config that was used wrongly (exit code 2), as opposed to work that failed (exit code 1).
class UsageError : public Error {
 public:
  using Error::Error;
};

}  // namespace daumier

/// Always on, in Release too. DAUMIER_CHECK(n == m, "faces has {} rows, expected {}", n, m);
#define DAUMIER_CHECK(condition, ...)                                   \
  do {                                                                  \
    if (!(condition)) throw ::daumier::Error(fmt::format(__VA_ARGS__)); \
  } while (false)
