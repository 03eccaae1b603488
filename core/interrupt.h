#pragma once
#include <stop_token>

namespace daumier {

/// From now on the first Ctrl-C (SIGINT) or SIGTERM only sets a flag and requests the stop of InterruptToken, so that
/// work can end at a safe point; a second one kills.
void CatchInterrupts();
bool Interrupted();
/// Its stop is requested by the first signal, from a thread that waits for it. A token from before
/// SetInterrupted(false) stays stopped; later ones are new. Thread-safe.
std::stop_token InterruptToken();
/// For tests: as if Ctrl-C had been pressed / forget it.
void SetInterrupted(bool value);

}  // namespace daumier
