// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// The program `transillum`.
#include "cli/messages.h"
#include "cli/program.h"

int main(int argc, char** argv) {
  using namespace transillum::cli;
  prepare_process();
  return run_program(argc, argv, print_message);
}
