#pragma once

namespace daumier::cli {

/// The program `daumier`: parses the command line, runs its verb and writes what went wrong to stderr. Returns the exit
/// status: 0 done, 1 failed, 2 misused.
int RunProgram(int argc, char** argv);

}  // namespace daumier::cli
