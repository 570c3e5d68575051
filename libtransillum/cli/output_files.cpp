// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "output_files.h"

#include <fmt/format.h>

#include <filesystem>
#include <set>

#include "transillum/errors.h"
#include "transillum/files.h"

namespace transillum::cli {

void check_output_files(const std::vector<std::string>& files, const std::string& scene) {
  std::set<std::filesystem::path> seen;
  for (const std::string& file : files) {
    check_writable(file);
    std::error_code ignored;
    if (std::filesystem::equivalent(file, scene, ignored)) {
      throw InputError(fmt::format("{}: would overwrite the scene file", file));
    }
    if (!seen.insert(std::filesystem::weakly_canonical(std::filesystem::absolute(file))).second) {
      throw InputError(fmt::format("{}: given twice as an output file", file));
    }
  }
}

}  // namespace transillum::cli
