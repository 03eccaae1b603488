#pragma once
#include "core/files.h"
#include "studio/sketch_desk.h"
#include "tests/studio/plain_desk.h"

#include <gtest/gtest.h>

#include <string>

namespace daumier::studio {

/// Sessions of the synthetic face in a folder that desks open one after the other.
class SketchDeskTest : public ::testing::Test {
 protected:
  SketchDesk OpenDesk() const { return SketchDesk(folder_.path(), testing::PlainSketchPredictor(), nullptr); }
  static geometry::Points Neutral() { return testing::PlainSketchPredictor()->run().face_template.neutral; }
  std::string Bytes(const std::string& id, const char* file = "session.json") const {
    return ReadFile(folder_ / id / file);
  }
  /// Whether nothing at all is in the folder.
  bool IsEmpty() const { return std::filesystem::is_empty(folder_.path()); }

  const testing::TempDir folder_;
};

inline Json EventOf(const char* what) {
  return {{"do", what}};
}

/// States are equal when the last event's time and effect are left out.
inline Json WithoutEvent(Json state) {
  for (const char* key : {"milliseconds", "changed", "gesture"}) state.erase(key);
  return state;
}

/// Erases the middle of the first curve of a state, as a person sees it on the sheet.
inline Json EraseEvent(const Json& state) {
  const Json& points = state["lines"][0]["points"];
  return {{"do", "erase"}, {"points", Json::array({points[points.size() / 2]})}};
}

}  // namespace daumier::studio
