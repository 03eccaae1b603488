#include "core/config.h"

#include "core/error.h"
#include "core/files.h"
#include "core/toml_bounds.h"

#include <toml++/toml.h>

#include <algorithm>
#include <cmath>

namespace daumier {
namespace fs = std::filesystem;
namespace {

std::string Where(const fs::path& path, const toml::source_region& source) {
  return fmt::format("{}:{}", path.string(), source.begin.line);
}

Json ToJson(const toml::node& node, const fs::path& path);

/// Keys in the order of the file.
Json ToJson(const toml::table& table, const fs::path& path) {
  std::vector<std::pair<const toml::key*, const toml::node*>> entries;
  for (const auto& [key, node] : table) entries.emplace_back(&key, &node);
  std::stable_sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) {
    const toml::source_position &left = a.first->source().begin, &right = b.first->source().begin;
    return std::tie(left.line, left.column) < std::tie(right.line, right.column);
  });
  Json json = Json::object();
  for (const auto& [key, node] : entries) json[std::string(key->str())] = ToJson(*node, path);
  return json;
}

Json ToJson(const toml::node& node, const fs::path& path) {
  switch (node.type()) {
    case toml::node_type::table:
      return ToJson(*node.as_table(), path);
    case toml::node_type::array: {
      Json json = Json::array();
      for (const toml::node& element : *node.as_array()) json.push_back(ToJson(element, path));
      return json;
    }
    case toml::node_type::string:
      return node.as_string()->get();
    // Positive numbers become unsigned, as in JSON text, so that equal configs compare equal wherever they come from.
    case toml::node_type::integer: {
      const int64_t value = node.as_integer()->get();
      return value >= 0 ? Json(static_cast<uint64_t>(value)) : Json(value);
    }
    case toml::node_type::floating_point:
      return node.as_floating_point()->get();
    case toml::node_type::boolean:
      return node.as_boolean()->get();
    default:
      break;
  }
  throw UsageError(
      fmt::format("{}: dates and times are not used here; put quotes around a text", Where(path, node.source())));
}

/// Keys of `over` replace those of `base`; tables are merged key by key.
void Merge(Json& base, const Json& over) {
  for (const auto& [key, value] : over.items()) {
    const auto found = base.find(key);
    if (found != base.end() && found->is_object() && value.is_object()) {
      Merge(*found, value);
    } else {
      base[key] = value;
    }
  }
}

Json LoadFile(const fs::path& path, std::vector<fs::path> children) {
  const fs::path canonical = fs::weakly_canonical(path);
  if (std::find(children.begin(), children.end(), canonical) != children.end()) {
    throw UsageError(fmt::format("{}: is its own parent", path.string()));
  }
  children.push_back(canonical);

  if (fs::is_directory(path)) {
    const fs::path of_run = path / "resolved.toml";
    throw UsageError(fmt::format("{} is a folder (expected a TOML file). Name the file{}", path.string(),
                                 fs::exists(of_run) ? ": of a run it is " + of_run.string() : ""));
  }
  toml::table table;
  try {
    const std::string text = ReadFile(path);
    if (const std::string deep = TooDeepInToml(text); !deep.empty())
      throw UsageError(fmt::format("{}: {}", path.string(), deep));
    table = toml::parse(text);
  } catch (const toml::parse_error& error) {
    throw UsageError(fmt::format("{}: {}", Where(path, error.source()), error.description()));
  } catch (const Error& error) {
    throw UsageError(error.what());
  }
  const toml::node* const parent_node = table.get("parent");
  if (parent_node == nullptr) return ToJson(table, path);
  if (!parent_node->is_string()) {
    throw UsageError(fmt::format("{}: 'parent' has to be a file name in quotes", Where(path, parent_node->source())));
  }
  const fs::path parent = path.parent_path() / parent_node->as_string()->get();
  const std::string parent_where = Where(path, parent_node->source());
  table.erase("parent");
  if (!fs::exists(parent)) throw UsageError(fmt::format("{}: parent {} does not exist", parent_where, parent.string()));
  Json json = LoadFile(parent, std::move(children));
  Merge(json, ToJson(table, path));
  return json;
}

constexpr size_t kShownOverride = 40;  ///< Characters of one that is too deep.

bool IsBareKey(std::string_view key) {
  return !key.empty() &&
         std::all_of(key.begin(), key.end(), [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-'; });
}

/// A TOML value, else the text itself. @throws UsageError where it begins like a TOML list, table or text and is none.
Json ParseValue(const std::string& text, const std::string& override_text) {
  const bool has_newline = text.find_first_of("\r\n") != std::string::npos;
  if (const std::string deep = TooDeepInToml(text); !deep.empty())
    throw UsageError(fmt::format("override '{} ...': {}", override_text.substr(0, kShownOverride), deep));
  if (!has_newline) {
    try {
      const toml::table table = toml::parse("value = " + text);
      const toml::node& node = *table.get("value");
      const bool is_time = node.is_date() || node.is_time() || node.is_date_time();
      return is_time ? Json(text) : ToJson(node, "override");
    } catch (const toml::parse_error& error) {
      if (!text.empty() && std::string_view("[{\"'").find(text[0]) != std::string_view::npos) {
        throw UsageError(fmt::format("override '{}': {}", override_text, error.description()));
      }
    }
  }
  return text;
}

void ApplyOverride(Json& config, const std::string& text) {
  const size_t equals = text.find('=');
  if (equals == std::string::npos)
    throw UsageError(fmt::format("override '{}' is not of the form key=value{}", text,
                                 fs::exists(text) ? ". A file or folder follows its key, as in faces=FOLDER" : ""));
  if (const std::string deep = TooDeepInToml(text.substr(0, equals)); !deep.empty())
    throw UsageError(fmt::format("override '{} ...': {}", text.substr(0, kShownOverride), deep));
  Json* table = &config;
  std::string_view rest = std::string_view(text).substr(0, equals);
  for (;;) {
    const size_t dot = rest.find('.');
    const std::string key(rest.substr(0, dot));
    if (!IsBareKey(key)) throw UsageError(fmt::format("override '{}': '{}' is no key", text, key));
    Json& value = (*table)[key];
    if (dot == std::string_view::npos) {
      value = ParseValue(text.substr(equals + 1), text);
      return;
    }
    if (value.is_null()) value = Json::object();
    if (!value.is_object()) throw UsageError(fmt::format("override '{}': '{}' is no table", text, key));
    table = &value;
    rest.remove_prefix(dot + 1);
  }
}

std::string QuoteText(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      quoted += '\\';
      quoted += c;
    } else if (code < 0x20 || code == 0x7f) {
      quoted += fmt::format("\\u{:04x}", code);
    } else {
      quoted += c;
    }
  }
  return quoted + '"';
}

std::string KeyToToml(const std::string& key) {
  return IsBareKey(key) ? key : QuoteText(key);
}

std::string ValueToToml(const Json& value) {
  std::vector<std::string> parts;
  switch (value.type()) {
    case Json::value_t::object:
      for (const auto& [key, element] : value.items()) parts.push_back(KeyToToml(key) + " = " + ValueToToml(element));
      return fmt::format("{{{}}}", fmt::join(parts, ", "));
    case Json::value_t::array:
      for (const Json& element : value) parts.push_back(ValueToToml(element));
      return fmt::format("[{}]", fmt::join(parts, ", "));
    case Json::value_t::string:
      return QuoteText(value.get<std::string>());
    case Json::value_t::number_float: {
      const auto number = value.get<double>();
      const std::string text = fmt::format("{}", number);  // The shortest text that gives the same number.
      return std::isfinite(number) && text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
    }
    case Json::value_t::number_unsigned:
      DAUMIER_CHECK(value.get<uint64_t>() <= uint64_t{INT64_MAX}, "{} does not fit a TOML integer", value.dump());
      return value.dump();
    case Json::value_t::number_integer:
    case Json::value_t::boolean:
      return value.dump();
    default:
      break;
  }
  throw Error("a config holds a null, which TOML cannot say");
}

void AppendToml(const Json& table, const std::string& prefix, std::string& text) {
  for (const auto& [key, value] : table.items()) {
    const std::string dotted = prefix + KeyToToml(key);
    if (value.is_object() && !value.empty()) {
      AppendToml(value, dotted + ".", text);
    } else {
      text += fmt::format("{} = {}\n", dotted, ValueToToml(value));
    }
  }
}

}  // namespace

Json LoadConfig(const fs::path& path, const std::vector<std::string>& overrides) {
  Json config = path.empty() ? Json::object() : LoadFile(path, {});
  for (const std::string& text : overrides) ApplyOverride(config, text);
  return config;
}

std::string ToToml(const Json& config) {
  DAUMIER_CHECK(config.is_object(), "a config is a table");
  std::string text;
  AppendToml(config, "", text);
  return text;
}

}  // namespace daumier
