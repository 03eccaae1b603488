#include "cli/program.h"

int main(int argc, char** argv) {
  return daumier::cli::RunProgram(argc, argv);
}
