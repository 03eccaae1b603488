#pragma once
#include <optional>
#include <string_view>

namespace daumier::geometry {

/// The number that a whole word of a text file spells, whatever the locale: a decimal number that may begin with +, or
/// a NaN or infinity as C libraries print them (nan, -nan(ind), inf) and as Microsoft's did before 2015 (1.#QNAN,
/// -1.#IND00, 1.#INF). Beyond the range of double it is infinite or 0. Absent where the word is anything else.
std::optional<double> ParseNumber(std::string_view word);

}  // namespace daumier::geometry
