#include "geometry/number_text.h"

#include <charconv>
#include <limits>

namespace daumier::geometry {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// "1.#QNAN", "1.#SNAN", "1.#IND" and "1.#INF", where zeros may follow; absent for other words.
std::optional<double> ParseMicrosoftName(std::string_view word) {
  constexpr std::string_view kBegin = "1.#";
  if (!word.starts_with(kBegin)) return std::nullopt;
  word.remove_prefix(kBegin.size());
  if (word.starts_with("INF")) return kInfinity;
  if (word.starts_with("QNAN") || word.starts_with("SNAN") || word.starts_with("IND"))
    return std::numeric_limits<double>::quiet_NaN();
  return std::nullopt;
}

/// Of a well-formed number without sign that is out of range: whether it is too large, not too small.
bool IsTooLarge(std::string_view digits) {
  const size_t exponent = digits.find_first_of("eE");
  if (exponent != digits.npos) return digits.substr(exponent + 1, 1) != "-";
  return digits.substr(0, digits.find('.')).find_first_not_of('0') != digits.npos;
}

}  // namespace

std::optional<double> ParseNumber(std::string_view word) {
  const bool has_sign = word.starts_with('+') || word.starts_with('-');
  const double sign = word.starts_with('-') ? -1.0 : 1.0;
  if (has_sign) word.remove_prefix(1);
  if (word.starts_with('-')) return std::nullopt;
  const char* const end = word.data() + word.size();
  double value = 0;
  const auto [position, error] = std::from_chars(word.data(), end, value);
  if (position == end && error == std::errc()) return sign * value;
  if (position == end && error == std::errc::result_out_of_range) return sign * (IsTooLarge(word) ? kInfinity : 0.0);
  if (const auto named = ParseMicrosoftName(word)) return sign * *named;
  return std::nullopt;
}

}  // namespace daumier::geometry
