#include "cli/program.h"

#include <cstdio>
#include <cstdlib>

/// Ends without the libraries' own ends, all files being written by then: OpenBLAS waits there for ever for threads that it
/// could not start for lack of memory.
int main(int argc, char** argv) {
  const int exit_code = daumier::cli::RunProgram(argc, argv);
  std::fflush(nullptr);
  std::_Exit(exit_code);
}
