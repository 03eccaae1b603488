#pragma once
#include "core/device.h"

#include <filesystem>

namespace daumier::cli {

struct SessionArguments {
  std::filesystem::path session;
  std::filesystem::path run;  ///< A sketch run or weights of one.
  std::filesystem::path out;
  Device device = {};
};

/// Replays a recorded session (systems/sketch/session_file.h) and writes `out`, whole or not at all: of each state
/// NNN.svg, its lines on the canvas, and NNN.obj, where it has a face; sheet.png, lines, front and side of at most 24 states in
/// order, the last among them; session.json, a copy; manifest.json (kind "session", details.states). Equal sessions give equal bytes.
/// @throws UsageError as CheckReplacedFolder, or if the run is of another task; Error as sketch::Replay.
void ReplaySession(const SessionArguments& arguments);

}  // namespace daumier::cli
