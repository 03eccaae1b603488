#pragma once

namespace daumier {

/// From now on the first Ctrl-C (SIGINT) or SIGTERM only sets a flag, so that work can end at a safe point; a second
/// one kills.
void CatchInterrupts();
bool Interrupted();
/// For tests: as if Ctrl-C had been pressed / forget it.
void SetInterrupted(bool value);

}  // namespace daumier
