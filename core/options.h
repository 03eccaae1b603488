#pragma once
#include "core/error.h"
#include "core/json.h"

#include <set>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

/// Options are plain structs that define each field once; parsing, range check, help text and resolved.toml come from
/// that:
///
///     struct ExaggerationOptions {
///       double gamma = 0.2;
///       template <class V> void Visit(V&& visit) {
///         visit("gamma", gamma, Range{0.0, 0.8}, "Exponent of |Gaussian curvature| that scales gradients.");
///       }
///     };
namespace daumier {

/// The closed interval of values that a number, or each number of a list, may take.
struct Range {
  double min;
  double max;
};
/// The words that a text option may take.
struct Choices {
  std::vector<std::string> words;
};
/// Any text, or a list of texts.
struct Text {};
/// true or false.
struct Flag {};
/// A nested options struct: a table in TOML, `table.key=value` on the command line.
struct Table {};

/// The entry of `known` that is nearest to `word` by edit distance; empty if none is near.
std::string NearestWord(std::string_view word, const std::set<std::string>& known);

/// Fills an options struct from `json`. `where` names the source in messages, for example a file.
/// @throws UsageError on an unknown key (suggesting the nearest), a wrong type or a value out of range
/// (with the help of that option).
template <class Options>
Options ParseOptions(const Json& json, std::string_view where = "options");

/// The struct as JSON, every field present, nested tables as objects. ParseOptions(ToJson(o)) == o.
template <class Options>
Json ToJson(const Options& options);

/// One line a field: dotted key, default, allowed values, meaning.
template <class Options>
std::string HelpText();

}  // namespace daumier

#include "core/options_impl.h"
