#pragma once
#include <string_view>
#include <vector>

namespace daumier::render {

/// Numbers separated by white space, in the notation of XML whatever the locale is; each is finite as a float.
/// @throws Error that quotes what is no such number.
std::vector<double> NumbersOf(std::string_view text);

}  // namespace daumier::render
