#include "core/training.h"

#include "core/error.h"
#include "core/no_data.h"

#include <filesystem>

namespace daumier {

Json WithSystemKey(Json config) {
  if (!config.contains("product")) return config;
  if (!config.contains("system")) config["system"] = config["product"];
  config.erase("product");
  return config;
}

std::string SystemOfConfig(const Json& config, const std::string& where) {
  const Json system = WithSystemKey(config).value("system", Json("sketch"));
  if (!system.is_string()) throw UsageError(fmt::format("{}: system is {}, expected a text", where, system.dump()));
  return system.get<std::string>();
}

Json WithAbsoluteData(Json config, const std::string& where) {
  Json& data = config.at("data");
  std::vector<std::string> keys;
  for (const auto& [database, folder] : data.items()) keys.push_back(fmt::format("data.{}=FOLDER", database));
  for (auto& [database, folder] : data.items()) {
    if (folder == kNoData) continue;
    if (folder == "") {
      throw UsageError(fmt::format("{}: it needs {}, made by `daumier dataset`", where, fmt::join(keys, " and ")));
    }
    folder = std::filesystem::absolute(folder.get<std::string>()).lexically_normal().string();
  }
  return config;
}

}  // namespace daumier
