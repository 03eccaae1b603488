#pragma once
// The templates behind core/options.h: visitors that read, write and describe the fields of an options struct.
#include "core/options.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace daumier {

/// What HelpText prints of one field.
struct FieldInfo {
  std::string key;      ///< Dotted: "exaggeration.gamma".
  std::string value;    ///< The default, in TOML syntax.
  std::string allowed;  ///< "0 to 0.8", "one of: front side", "true or false"; empty for any text.
  std::string help;
};

namespace options_internal {

std::string JoinKey(std::string_view prefix, std::string_view name);
std::string DescribeAllowed(const Range& range);
std::string DescribeAllowed(const Choices& choices);
std::string DescribeAllowed(const Text& text);
std::string DescribeAllowed(const Flag& flag);
std::string FormatHelp(const std::vector<FieldInfo>& fields);

/// A value that an option does not take.
class OptionError : public UsageError {
 public:
  OptionError(const std::string& message, std::string option_key) : UsageError(message), key(std::move(option_key)) {}
  std::string key;  ///< "levels[1]": of a list with the position.
};

/// @throws UsageError: the message of `error` and the help of its option alone.
[[noreturn]] void FailWithHelp(const OptionError& error, const std::vector<FieldInfo>& fields);
[[noreturn]] void FailUnknownKey(std::string_view where, const std::string& key, const std::set<std::string>& known);
[[noreturn]] void FailType(std::string_view where, const std::string& key, std::string_view expected,
                           const Json& found);
void CheckRange(std::string_view where, const std::string& key, double value, const Range& range);
void CheckChoice(std::string_view where, const std::string& key, const std::string& value, const Choices& choices);

template <class T>
struct IsVector : std::false_type {};
template <class T>
struct IsVector<std::vector<T>> : std::true_type {};

/// Which kinds fit which C++ types: a mismatch does not compile.
template <class T, class Kind>
constexpr bool KindFits() {
  if constexpr (IsVector<T>::value) {
    return !std::is_same_v<typename T::value_type, bool> && KindFits<typename T::value_type, Kind>();
  } else if constexpr (std::is_same_v<T, bool>) {
    return std::is_same_v<Kind, Flag>;
  } else if constexpr (std::is_arithmetic_v<T>) {
    return std::is_same_v<Kind, Range>;
  } else if constexpr (std::is_same_v<T, std::string>) {
    return std::is_same_v<Kind, Text> || std::is_same_v<Kind, Choices>;
  } else {
    return std::is_same_v<Kind, Table>;
  }
}

template <class T>
bool FitsInteger(const Json& json) {
  if (!json.is_number_integer()) return false;
  return json.is_number_unsigned() ? std::in_range<T>(json.get<uint64_t>()) : std::in_range<T>(json.get<int64_t>());
}

/// Reads one value, or each value of a list.
template <class T, class Kind>
void ReadValue(const Json& json, std::string_view where, const std::string& key, const Kind& kind, T& field) {
  if constexpr (IsVector<T>::value) {
    if (!json.is_array()) FailType(where, key, "a list", json);
    field.assign(json.size(), {});
    for (size_t i = 0; i < json.size(); ++i) ReadValue(json[i], where, fmt::format("{}[{}]", key, i), kind, field[i]);
  } else if constexpr (std::is_same_v<T, bool>) {
    if (!json.is_boolean()) FailType(where, key, "true or false", json);
    field = json.get<bool>();
  } else if constexpr (std::is_integral_v<T>) {
    if (!FitsInteger<T>(json)) FailType(where, key, "an integer", json);
    CheckRange(where, key, static_cast<double>(json.get<T>()), kind);
    field = json.get<T>();
  } else if constexpr (std::is_floating_point_v<T>) {
    if (!json.is_number()) FailType(where, key, "a number", json);
    CheckRange(where, key, json.get<double>(), kind);
    field = json.get<T>();
  } else {
    if (!json.is_string()) FailType(where, key, "a text", json);
    if constexpr (std::is_same_v<Kind, Choices>) CheckChoice(where, key, json.get<std::string>(), kind);
    field = json.get<std::string>();
  }
}

/// Writes the struct as JSON.
struct Writer {
  Json json = Json::object();

  template <class T, class Kind>
  void operator()(std::string_view name, T& field, const Kind&, std::string_view) {
    static_assert(KindFits<T, Kind>(), "this kind of option does not fit the type of its field");
    if constexpr (std::is_same_v<Kind, Table>) {
      json[std::string(name)] = ToJson(field);
    } else {
      json[std::string(name)] = field;
    }
  }
};

/// Lists the fields, nested ones under dotted keys.
struct Describer {
  std::string prefix;
  std::vector<FieldInfo> fields;

  template <class T, class Kind>
  void operator()(std::string_view name, T& field, const Kind& kind, std::string_view help) {
    const std::string key = JoinKey(prefix, name);
    if constexpr (std::is_same_v<Kind, Table>) {
      Describer nested{key, {}};
      field.Visit(nested);
      fields.insert(fields.end(), nested.fields.begin(), nested.fields.end());
    } else {
      fields.push_back({key, Json(field).dump(), DescribeAllowed(kind), std::string(help)});
    }
  }
};

/// Fills the struct from JSON; records which names were read; the rest are unknown keys.
class Reader {
 public:
  Reader(const Json& json, std::string_view where, std::string prefix, const std::set<std::string>& all_keys)
      : json_(json), where_(where), prefix_(std::move(prefix)), all_keys_(all_keys) {}

  template <class Options>
  void Read(Options& options) {
    if (!json_.is_object()) FailType(where_, prefix_.empty() ? "(top level)" : prefix_, "a table", json_);
    options.Visit(*this);
    for (const auto& [name, value] : json_.items()) {
      if (names_.count(name) == 0) FailUnknownKey(where_, JoinKey(prefix_, name), all_keys_);
    }
  }

  template <class T, class Kind>
  void operator()(std::string_view name, T& field, const Kind& kind, std::string_view) {
    static_assert(KindFits<T, Kind>(), "this kind of option does not fit the type of its field");
    names_.emplace(name);
    const auto found = json_.find(std::string(name));
    if (found == json_.end()) return;
    const std::string key = JoinKey(prefix_, name);
    if constexpr (std::is_same_v<Kind, Table>) {
      Reader(*found, where_, key, all_keys_).Read(field);
    } else {
      ReadValue(*found, where_, key, kind, field);
    }
  }

 private:
  const Json& json_;
  std::string_view where_;
  std::string prefix_;
  const std::set<std::string>& all_keys_;
  std::set<std::string> names_;
};

}  // namespace options_internal

template <class Options>
std::vector<FieldInfo> DescribeFields() {
  Options defaults;
  options_internal::Describer describer;
  defaults.Visit(describer);
  return std::move(describer.fields);
}

template <class Options>
Options ParseOptions(const Json& json, std::string_view where) {
  const std::vector<FieldInfo> fields = DescribeFields<Options>();
  std::set<std::string> keys;
  for (const FieldInfo& field : fields) keys.insert(field.key);
  Options options;
  try {
    options_internal::Reader(json, where, "", keys).Read(options);
  } catch (const options_internal::OptionError& error) {
    options_internal::FailWithHelp(error, fields);
  }
  return options;
}

template <class Options>
Json ToJson(const Options& options) {
  Options copy = options;  // Visit serves reading too, and so is not const.
  options_internal::Writer writer;
  copy.Visit(writer);
  return std::move(writer.json);
}

template <class Options>
std::string HelpText() {
  return options_internal::FormatHelp(DescribeFields<Options>());
}

}  // namespace daumier
