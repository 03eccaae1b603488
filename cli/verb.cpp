#include "cli/verb.h"

#include "core/config.h"

#include <fmt/core.h>

namespace daumier::cli {

Json ConfigArguments::Load() const {
  return LoadConfig(file, overrides);
}

std::string ConfigArguments::Where() const {
  return file.empty() ? "the command line" : file.string();
}

void AddConfigArguments(CLI::App& command, ConfigArguments& arguments) {
  command.add_option("--config", arguments.file, "TOML file of options; key=value overrides it");
  command.add_option("overrides", arguments.overrides, "key=value or table.key=value, in TOML syntax");
}

namespace {

void PrintIndented(const Json& value, int depth) {
  for (const auto& [key, entry] : value.items()) {
    const std::string indent(2 * depth, ' ');
    if (entry.is_object()) {
      fmt::print("{}{}\n", indent, key);
      PrintIndented(entry, depth + 1);
    } else {
      fmt::print("{}{:<{}} {}\n", indent, key, 28 - 2 * depth,
                 entry.is_string() ? entry.get<std::string>()
                 : entry.is_null() ? "none"
                                   : entry.dump());
    }
  }
}

}  // namespace

void PrintResult(const Json& result, bool as_json) {
  if (as_json) {
    fmt::print("{}\n", result.dump(2));
  } else {
    PrintIndented(result, 0);
  }
}

}  // namespace daumier::cli
