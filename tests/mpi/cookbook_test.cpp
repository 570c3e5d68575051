// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Runs the commands of transillum-mpi that COOKBOOK.md prints.
#include <gmock/gmock.h>

#include "mpi_call.h"
#include "support/printed_commands.h"

namespace transillum {
namespace {

/// mpirun with the options of these tests, up to the number of processes.
std::string mpirun_call() {
  std::string call;
  for (const std::string& word : testing::mpi_command(1, {})) {
    if (word == "-n") {
      break;
    }
    call += "'" + word + "' ";
  }
  return call;
}

TEST(Cookbook, CommandsOfProcessesGiveTheOutputThatItShows) {
  const std::filesystem::path data = TRANSILLUM_DATA_DIR;
  const test::CommandFolder folder(data);
  folder.add_program("mpirun", mpirun_call());
  folder.add_program("transillum-mpi", TRANSILLUM_MPI_PROGRAM);
  folder.add_program("transillum", TRANSILLUM_ALONE);
  int count = 0;
  std::string output;
  for (const test::CodeBlock& block :
       test::code_blocks(data.parent_path() / "libtransillum/COOKBOOK.md")) {
    if (block.language == "sh" && block.text.find("transillum-mpi") != std::string::npos) {
      const auto result = folder.run(block.text);
      EXPECT_EQ(result.status, 0) << block.text << result.output;
      output = result.output;
      ++count;
    } else if (block.language == "text" && !output.empty()) {
      EXPECT_THAT(test::lines_missing(output, block.text), ::testing::IsEmpty()) << output;
      output.clear();
    }
  }
  EXPECT_GE(count, 1);
}

}  // namespace
}  // namespace transillum
