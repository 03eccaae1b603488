#include "studio/session_text.h"

#include <fmt/format.h>

namespace daumier::studio {

SessionText::SessionText(const sketch::SessionScript& script) {
  const Json sheet = {script.width, script.height};
  lines_ = fmt::format("{{\"version\": {}, \"sheet\": {}", sketch::SessionScript::kVersion, sheet.dump());
  if (!script.begin.empty()) lines_ += fmt::format(", \"begin\": {}", Json(script.begin).dump());
  lines_ += ", \"events\": [";
  for (const sketch::SessionEvent& event : script.events) Append(event);
}

void SessionText::Append(const sketch::SessionEvent& event) {
  lines_ += is_empty_ ? "\n" : ",\n";
  lines_ += EventToJson(event).dump();
  is_empty_ = false;
}

}  // namespace daumier::studio
