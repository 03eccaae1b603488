#include "render/number_list.h"

#include "core/error.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace daumier::render {

std::vector<double> NumbersOf(std::string_view text) {
  constexpr std::string_view kBetweenNumbers = " \t\r\n";
  std::vector<double> numbers;
  for (;;) {
    text.remove_prefix(std::min(text.find_first_not_of(kBetweenNumbers), text.size()));
    if (text.empty()) return numbers;
    const std::string_view word = text.substr(0, text.find_first_of(kBetweenNumbers));
    double value = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    DAUMIER_CHECK(error == std::errc() && end == word.data() + word.size() && std::isfinite(float(value)),
                  "'{}' is not a finite number", word.substr(0, 40));
    numbers.push_back(value);
    text.remove_prefix(word.size());
  }
}

}  // namespace daumier::render
