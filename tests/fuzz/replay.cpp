// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// Main program of a fuzz target without libFuzzer: runs the target on every file of the given
// folders. Ignores arguments that begin with a dash, which are options of libFuzzer.
#include <algorithm>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

std::vector<std::filesystem::path> files_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.is_regular_file()) {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// Runs the target on one file; returns whether it passed.
bool replay(const std::filesystem::path& path) {
  // Printed and flushed first, so the file is known if a sanitizer ends the program.
  std::cout << path.string() << std::endl;
  std::ifstream file(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  try {
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
    return true;
  } catch (const std::exception& error) {
    std::cout << "  " << error.what() << std::endl;
    return false;
  }
}

}  // namespace

int main(int argc, char** argv) {
  int replayed = 0, failed = 0;
  for (int k = 1; k < argc; ++k) {
    if (argv[k][0] == '-') {
      continue;
    }
    for (const std::filesystem::path& file : files_in(argv[k])) {
      ++replayed;
      if (!replay(file)) {
        ++failed;
      }
    }
  }
  std::cout << replayed << " files, " << failed << " failed\n";
  // An empty corpus is an error.
  return replayed > 0 && failed == 0 ? 0 : 1;
}
