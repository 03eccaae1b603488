#pragma once
#include "core/error.h"
#include "core/json.h"
#include "core/options.h"

#include <fmt/format.h>

#include <string>

namespace daumier::studio {

/// A text of a request. @throws UsageError without it.
inline std::string TextIn(const Json& body, const char* key) {
  const Json value = body.value(key, Json());
  if (!value.is_string()) throw UsageError(fmt::format("the request has no text '{}'", key));
  return value.get<std::string>();
}

/// The options of a request; without `options` the defaults. @throws UsageError as ParseOptions.
template <class Options>
Options OptionsIn(const Json& body) {
  return ParseOptions<Options>(body.value("options", Json::object()), "options");
}

}  // namespace daumier::studio
