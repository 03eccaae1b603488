#pragma once
#include "systems/sketch/session_file.h"

#include <string>

namespace daumier::studio {

/// The text of a recorded session's file (sketch::SessionToJson), an event a line, which grows with the session: of an event more only that event
/// is put into words. The whole of it is written in one atomic step (docs/studio.md has times).
class SessionText {
 public:
  explicit SessionText(const sketch::SessionScript& script);

  void Append(const sketch::SessionEvent& event);
  /// What sketch::ReadSession reads. Valid with an event at least.
  std::string text() const { return lines_ + "\n]}\n"; }

 private:
  std::string lines_;
  bool is_empty_ = true;
};

}  // namespace daumier::studio
