// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdlib>
#include <string>
#include <vector>

#include "support/program_call.h"

namespace transillum::testing {

/// mpirun refuses to run as root without these variables.
inline const bool root_is_meant = ::setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1) == 0 &&
                                  ::setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1) == 0;

/// The command line of transillum-mpi in `ranks` processes, without a network and on however few
/// cores.
inline std::vector<std::string> mpi_command(int ranks, const std::vector<std::string>& arguments) {
  std::vector<std::string> command{TRANSILLUM_MPIRUN,
                                   "--oversubscribe",
                                   "--mca",
                                   "btl",
                                   "self,vader",
                                   "--mca",
                                   "btl_vader_single_copy_mechanism",
                                   "none",
                                   "-n",
                                   std::to_string(ranks),
                                   TRANSILLUM_MPI_PROGRAM};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return command;
}

inline ProgramResult run_mpi(int ranks, const std::vector<std::string>& arguments,
                             const std::string& folder = {}) {
  return run_program(mpi_command(ranks, arguments), {}, {}, folder);
}

/// The program `transillum`.
inline ProgramResult run_alone(std::vector<std::string> arguments, const std::string& folder = {}) {
  arguments.insert(arguments.begin(), TRANSILLUM_ALONE);
  return run_program(arguments, {}, {}, folder);
}

}  // namespace transillum::testing
