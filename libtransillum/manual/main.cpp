// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// A program of the build, which is not installed: writes the manual pages of all programs and their
// completions for bash, zsh and fish, from the definitions that parse their command lines.
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "cli/commands/commands.h"
#include "cli/program.h"
#include "completions.h"
#include "man_pages.h"
#ifdef TRANSILLUM_WITH_VIEWER
#include "window/command_line.h"
#endif

namespace transillum::manual {
namespace {

namespace fs = std::filesystem;

void write(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream stream(file, std::ios::binary);
  stream << text;
  if (!stream.flush()) {
    throw std::runtime_error(file.string() + " cannot be written");
  }
}

Introduction introduction(const std::string& date) {
  Introduction introduction;
  introduction.version = TRANSILLUM_VERSION;
  introduction.date = date;
  return introduction;
}

void write_completions(const fs::path& folder, const Program& program) {
  write(folder / "bash" / program.name, bash_completion(program));
  write(folder / "zsh" / ("_" + program.name), zsh_completion(program));
  write(folder / "fish" / (program.name + ".fish"), fish_completion(program));
}

void write_pages(const fs::path& folder, const std::vector<ManPage>& pages) {
  for (const ManPage& page : pages) {
    write(folder / "man" / (page.name + ".1"), page.text);
  }
}

void write_command_line(const fs::path& folder, const std::string& date, const CLI::App& app) {
  Program program = describe("transillum", app);
  Introduction text = introduction(date);
  text.paragraphs = {
      "transillum computes diffuse light in a scene of polygons by the transillumination method: "
      "for each of M quasi-Monte Carlo directions, the visibility map on the plane perpendicular "
      "to the direction says exactly how much of each patch every other patch sees along it.",
      "A scene is a file or a built-in scene. Results go to files or standard output, progress and "
      "messages to standard error."};
  text.see_also = {"transillum-viewer", "transillum-mpi"};
  write_pages(folder, man_pages(program, text));
  write_completions(folder, program);

  program.name = "transillum-mpi";
  program.self.summary = "Radiosity by several processes and machines";
  text.paragraphs = {
      "transillum-mpi has the commands of transillum for several processes of one machine or of "
      "several; it is started by mpirun or srun, as in",
      "mpirun -n 4 transillum-mpi solve sphere-flake:levels=3 -m 4096 --out flake.vtp",
      "The command solve shares its passes and form factors between the processes and writes the "
      "same bytes as one process; the first process runs the other commands alone. Each process "
      "takes the cores that it is bound to, and a part of the machine's memory.",
      "Write results to a file: mpirun of Open MPI 5 may lose parts of standard output while "
      "messages are written, unless with -q."};
  text.see_also = {"transillum", "mpirun"};
  write_pages(folder, {page_of_program(program, text)});
  write_completions(folder, program);
}

#ifdef TRANSILLUM_WITH_VIEWER
void write_viewer(const fs::path& folder, const std::string& date, const CLI::App& app) {
  const Program program = describe("transillum-viewer", app);
  Introduction text = introduction(date);
  text.paragraphs = {
      "transillum-viewer solves a scene of polygons for its diffuse light and shows how the result "
      "converges, direction by direction: the scene, the visibility map of a direction and how it "
      "is built, the BSP tree, form factors, and where the light of a patch comes from.",
      "The viewer opens scenes, results, sessions and lessons, and has lessons built in. F1 shows "
      "the "
      "keys."};
  text.see_also = {"transillum"};
  write_pages(folder, man_pages(program, text));
  write_completions(folder, program);
}
#endif

}  // namespace
}  // namespace transillum::manual

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: %s FOLDER DATE\n", argv[0]);
    return 2;
  }
  try {
    const std::filesystem::path folder = argv[1];
    const std::string date = argv[2];
    transillum::cli::with_definitions(
        [&](const CLI::App& app) { transillum::manual::write_command_line(folder, date, app); });
#ifdef TRANSILLUM_WITH_VIEWER
    transillum::viewer::with_definitions(
        [&](const CLI::App& app) { transillum::manual::write_viewer(folder, date, app); });
#endif
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
