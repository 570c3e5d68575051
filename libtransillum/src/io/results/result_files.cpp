// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <fmt/format.h>

#include <ostream>

#include "io/file_ending.h"
#include "io/results/result_writers.h"
#include "transillum/errors.h"
#include "transillum/files.h"

namespace transillum {
namespace {

using ResultWriter = void (*)(std::ostream&, const Solution&);

ResultWriter writer_for(const std::filesystem::path& path) {
  const std::string ending = lower_case_ending(path);
  if (ending == ".csv") {
    return write_result_csv;
  }
  if (ending == ".vtp") {
    return write_result_vtp;
  }
  if (ending == ".ply") {
    return write_result_ply;
  }
  if (ending == ".obj") {
    return write_result_obj;
  }
  throw InputError(
      fmt::format("{}: the name of a result must end in .csv, .vtp, .ply or .obj", path.string()));
}

}  // namespace

void check_result_path(const std::filesystem::path& path) {
  writer_for(path);
  check_writable(path);
}

void check_statistics_path(const std::filesystem::path& path) {
  if (lower_case_ending(path) != ".json") {
    throw InputError(
        fmt::format("{}: the name of a statistics file must end in .json", path.string()));
  }
  check_writable(path);
}

void write_result(const std::filesystem::path& path, const Solution& solution) {
  const ResultWriter write = writer_for(path);
  check_distinct({path.string()}, solution.scene->files());
  write_file_whole(path, [&](std::ostream& out) { write(out, solution); });
}

}  // namespace transillum
