#pragma once
#include "core/json.h"

#include <string>

/// key=value of `daumier avatar` that would have no effect.
namespace daumier::cli {

/// @throws UsageError naming a key of `config` that belongs to another style than `style`, or to light that is kept.
void CheckStyleKeys(const Json& config, const std::string& style);

/// Of a picture that is read as a portrait. @throws UsageError naming a key of `config` that drawings alone use.
void CheckPortraitKeys(const Json& config, const std::string& picture);

/// Of a picture that is read as a drawing. @throws UsageError naming a key of `config` that portraits alone use.
void CheckDrawingKeys(const Json& config, const std::string& picture);

}  // namespace daumier::cli
