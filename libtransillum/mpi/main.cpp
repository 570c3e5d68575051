// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The program `transillum-mpi`: the commands of `transillum`, started by mpirun or srun in several
// processes, which share the passes of `solve`. Rank 0 alone runs the other commands; the rest
// wait.
#include <malloc.h>
#include <mpi.h>
#include <sched.h>

#include <algorithm>
#include <chrono>
#include <climits>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "cli/commands/commands.h"
#include "cli/messages.h"
#include "cli/processes.h"
#include "cli/program.h"
#include "leak_check.h"
#include "mpi_group.h"
#include "mpi_waiting.h"

namespace transillum::mpi {
namespace {

using namespace std::chrono_literals;

/// The first message of an error in this process. It is printed at the end, by one process.
char first_message[1024] = "";

void keep_message(std::string_view text) noexcept {
  if (first_message[0] == '\0') {
    text.copy(first_message, std::min(text.size(), sizeof first_message - 1));
  }
}

/// Prints the message, also where this is not the first process.
void print_kept_message(int rank) {
  const std::string text =
      rank == 0 ? first_message : "process " + std::to_string(rank) + ": " + first_message;
  cli::processes().sums.reset();
  cli::print_message(text);
}

/// Finds how many processes share this machine, and how many cores each has.
void look_at_machine(cli::Processes& processes) {
  MPI_Comm here = MPI_COMM_NULL;
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &here);
  MPI_Comm_size(here, &processes.here);
  cpu_set_t own;
  CPU_ZERO(&own);
  sched_getaffinity(0, sizeof own, &own);
  std::vector<cpu_set_t> all(static_cast<std::size_t>(processes.here));
  MPI_Allgather(&own, sizeof own, MPI_BYTE, all.data(), sizeof own, MPI_BYTE, here);
  const auto sharing = std::count_if(all.begin(), all.end(), [&own](const cpu_set_t& other) {
    return CPU_EQUAL(&own, &other) != 0;
  });
  processes.threads = std::max(1, CPU_COUNT(&own) / static_cast<int>(sharing));
  MPI_Comm_free(&here);
}

/// Ends the processes together with the largest of their statuses; prints one message.
/// @param comm used for nothing else, so that it is in order wherever the others are
int leave_together(MPI_Comm comm, int rank, int status) {
  const bool failed = first_message[0] != '\0';
  int all[2] = {status, failed ? INT_MAX - rank : 0};
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Iallreduce(MPI_IN_PLACE, all, 2, MPI_INT, MPI_MAX, comm, &request);
  // Where a process fails at a place at which the others do not expect it, they will not come.
  constexpr auto patience = 10s;
  const auto start = std::chrono::steady_clock::now();
  wait_for(
      request,
      [&] {
        if (failed && std::chrono::steady_clock::now() - start > patience) {
          print_kept_message(rank);
          MPI_Abort(MPI_COMM_WORLD, status);
        }
      },
      Pauses(20ms));
  // The checker does not see that wait_for() completes the request.
  // NOLINTBEGIN(clang-analyzer-optin.mpi.MPI-Checker)
  if (failed && INT_MAX - rank == all[1]) {
    print_kept_message(rank);
  }
  return all[0];
  // NOLINTEND(clang-analyzer-optin.mpi.MPI-Checker)
}

int run(int argc, char** argv) {
  int rank = 0, size = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  if (size == 1) {
    return cli::run_program(argc, argv, cli::print_message);
  }
  MPI_Comm leaving = MPI_COMM_NULL;
  MPI_Comm_dup(MPI_COMM_WORLD, &leaving);
  cli::Processes& processes = cli::processes();
  const auto group = std::make_shared<MpiGroup>();
  processes.sums = group;
  processes.traffic = [&group] { return group->traffic(); };
  look_at_machine(processes);
  const int status = cli::run_program(argc, argv, keep_message);
  const int agreed =
      leave_together(leaving, rank, status == cli::failed_elsewhere ? cli::success : status);
  processes.sums.reset();
  MPI_Comm_free(&leaving);
  return agreed;
}

}  // namespace
}  // namespace transillum::mpi

int main(int argc, char** argv) {
  transillum::cli::prepare_process();
  // Messages of some 100 kB come and go with every pass: their memory is kept, since getting it
  // from the system takes longer than writing it.
  mallopt(M_MMAP_THRESHOLD, 8 << 20);
  mallopt(M_TRIM_THRESHOLD, 64 << 20);
  int provided = MPI_THREAD_SINGLE;
  {
    const transillum::mpi::AllocationsOfMpi ignored;
    MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
  }
  if (provided < MPI_THREAD_FUNNELED) {
    transillum::cli::print_message("this MPI does not allow threads (MPI_THREAD_FUNNELED)");
    MPI_Abort(MPI_COMM_WORLD, transillum::cli::failure);
  }
  const int status = transillum::mpi::run(argc, argv);
  transillum::mpi::check_leaks();
  MPI_Finalize();
  return status;
}
