#include "core/options.h"

#include <algorithm>
#include <numeric>

namespace daumier {
namespace {

/// Levenshtein distance: the fewest insertions, deletions and substitutions of a character.
size_t EditDistance(std::string_view a, std::string_view b) {
  std::vector<size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), size_t{0});
  for (size_t i = 0; i < a.size(); ++i) {
    size_t diagonal = row[0];
    row[0] = i + 1;
    for (size_t j = 0; j < b.size(); ++j) {
      const size_t substituted = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({row[j] + 1, row[j + 1] + 1, substituted});
    }
  }
  return row.back();
}

std::string_view LastPart(std::string_view key) {
  return key.substr(key.rfind('.') + 1);
}

std::string Number(double value) {
  if (value == std::numeric_limits<double>::infinity()) return "infinity";
  if (value == -std::numeric_limits<double>::infinity()) return "-infinity";
  return fmt::format("{}", value);
}

/// The known key that was probably meant: near as a whole, or with the same or a near last part in another table.
std::string NearestKey(const std::string& key, const std::set<std::string>& known) {
  for (const std::string& candidate : known) {
    if (LastPart(candidate) == LastPart(key)) return candidate;
  }
  if (const std::string whole = NearestWord(key, known); !whole.empty()) return whole;
  std::set<std::string> last_parts;
  for (const std::string& candidate : known) last_parts.emplace(LastPart(candidate));
  const std::string last = NearestWord(LastPart(key), last_parts);
  for (const std::string& candidate : known) {
    if (!last.empty() && LastPart(candidate) == last) return candidate;
  }
  return "";
}

}  // namespace

std::string NearestWord(std::string_view word, const std::set<std::string>& known) {
  std::string nearest;
  size_t nearest_distance = (word.size() + 2) / 3 + 1;  // Farther words are no misspelling.
  for (const std::string& candidate : known) {
    const size_t distance = EditDistance(word, candidate);
    if (distance < nearest_distance) {
      nearest_distance = distance;
      nearest = candidate;
    }
  }
  return nearest;
}

namespace options_internal {

std::string JoinKey(std::string_view prefix, std::string_view name) {
  return prefix.empty() ? std::string(name) : fmt::format("{}.{}", prefix, name);
}

std::string DescribeAllowed(const Range& range) {
  return fmt::format("{} to {}", Number(range.min), Number(range.max));
}

std::string DescribeAllowed(const Choices& choices) {
  return fmt::format("one of: {}", fmt::join(choices.words, ", "));
}

std::string DescribeAllowed(const Text&) {
  return "";
}

std::string DescribeAllowed(const Flag&) {
  return "true or false";
}

std::string FormatHelp(const std::vector<FieldInfo>& fields) {
  size_t width = 0;
  for (const FieldInfo& field : fields) width = std::max(width, field.key.size() + field.value.size() + 3);
  std::string text;
  for (const FieldInfo& field : fields) {
    const std::string assignment = fmt::format("{} = {}", field.key, field.value);
    const std::string allowed = field.allowed.empty() ? "" : fmt::format(" ({})", field.allowed);
    text += fmt::format("  {:<{}}  {}{}\n", assignment, width, field.help, allowed);
  }
  return text;
}

void FailWithHelp(const OptionError& error, const std::vector<FieldInfo>& fields) {
  const std::string key = error.key.substr(0, error.key.find('['));
  const auto field = std::find_if(fields.begin(), fields.end(), [&](const FieldInfo& one) { return one.key == key; });
  if (field == fields.end()) throw UsageError(error.what());
  std::string help = FormatHelp({*field});
  help.pop_back();
  throw UsageError(fmt::format("{}\n{}", error.what(), help));
}

void FailUnknownKey(std::string_view where, const std::string& key, const std::set<std::string>& known) {
  const std::string nearest = NearestKey(key, known);
  if (!nearest.empty()) throw UsageError(fmt::format("{}: unknown key '{}'; did you mean '{}'?", where, key, nearest));
  throw UsageError(fmt::format("{}: unknown key '{}'; known are: {}", where, key, fmt::join(known, ", ")));
}

void FailType(std::string_view where, const std::string& key, std::string_view expected, const Json& found) {
  throw OptionError(fmt::format("{}: '{}' is {}, expected {}", where, key,
                                found.dump(-1, ' ', false, Json::error_handler_t::replace), expected),
                    key);
}

void CheckRange(std::string_view where, const std::string& key, double value, const Range& range) {
  if (value >= range.min && value <= range.max) return;  // Written so that NaN is out of every range.
  throw OptionError(fmt::format("{}: '{}' is {}, expected {}", where, key, value, DescribeAllowed(range)), key);
}

void CheckChoice(std::string_view where, const std::string& key, const std::string& value, const Choices& choices) {
  const std::set<std::string> words(choices.words.begin(), choices.words.end());
  if (words.count(value) == 1) return;
  const std::string nearest = NearestWord(value, words);
  throw OptionError(fmt::format("{}: '{}' is '{}', expected {}{}", where, key, value, DescribeAllowed(choices),
                                nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest)),
                    key);
}

}  // namespace options_internal
}  // namespace daumier
