// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Commands that documents print, and the output that they show. A block between lines of three
// backquotes with the language `sh` holds commands; a block `text` after it holds lines of their
// output, where … stands for any text.
#pragma once

#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "support/temporary_folder.h"

namespace transillum::test {

/// A block of code of a document.
struct CodeBlock {
  std::vector<std::string> headings;  ///< from the document's title to the nearest one
  std::string language, text;
  int line = 0;  ///< where it begins
};

inline std::string text_of_file(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

inline std::vector<CodeBlock> code_blocks(const std::filesystem::path& document) {
  std::istringstream text(text_of_file(document));
  std::vector<CodeBlock> blocks;
  std::vector<std::string> headings;
  bool inside = false;
  int number = 0;
  for (std::string line; std::getline(text, line);) {
    ++number;
    if (line.starts_with("```")) {
      if (!inside) {
        blocks.push_back({headings, line.substr(3), {}, number});
      }
      inside = !inside;
    } else if (inside) {
      blocks.back().text += line + '\n';
    } else if (line.starts_with("#")) {
      const std::size_t depth = line.find_first_not_of('#');
      headings.resize(depth - 1);
      headings.push_back(line.substr(depth + 1));
    }
  }
  return blocks;
}

/// Whether `line` is `pattern`, in which … stands for any text.
inline bool fits(std::string_view line, std::string_view pattern) {
  constexpr std::string_view any = "…";
  std::size_t gap = pattern.find(any);
  if (gap == std::string_view::npos) {
    return line == pattern;
  }
  if (!line.starts_with(pattern.substr(0, gap))) {
    return false;
  }
  line.remove_prefix(gap);
  pattern.remove_prefix(gap + any.size());
  while ((gap = pattern.find(any)) != std::string_view::npos) {
    const std::size_t place = line.find(pattern.substr(0, gap));
    if (place == std::string_view::npos) {
      return false;
    }
    line.remove_prefix(place + gap);
    pattern.remove_prefix(gap + any.size());
  }
  return line.ends_with(pattern);
}

/// The lines of `shown` that `output` does not have.
inline std::vector<std::string> lines_missing(const std::string& output, const std::string& shown) {
  std::vector<std::string> missing;
  std::istringstream lines(shown);
  for (std::string pattern; std::getline(lines, pattern);) {
    bool found = false;
    std::istringstream printed(output);
    for (std::string line; !found && std::getline(printed, line);) {
      found = fits(line, pattern);
    }
    if (!found) {
      missing.push_back(pattern);
    }
  }
  return missing;
}

/// A folder in which commands run as a reader would run them in the source tree: `data` is that
/// folder's, programs are found by their names.
class CommandFolder {
 public:
  explicit CommandFolder(const std::filesystem::path& data) {
    std::filesystem::create_symlink(data, folder_.path() / "data");
    std::filesystem::create_directory(folder_.path() / "bin");
  }
  /// @param call what the program `name` stands for, with its first arguments, for the shell
  void add_program(const std::string& name, const std::string& call) const {
    const std::string file = folder_.write("bin/" + name, "#!/bin/sh\nexec " + call + " \"$@\"\n");
    std::filesystem::permissions(file, std::filesystem::perms::owner_all);
  }

  struct Result {
    int status;          ///< exit status of the first command that fails; 0 if none does
    std::string output;  ///< standard output and standard error
  };
  Result run(const std::string& commands) const {
    const std::string script = folder_.write(".commands", commands);
    const std::string path = folder_.path().string(), log = path + "/.log";
    const std::string call = "cd '" + path + "' && PATH='" + path +
                             "/bin:/usr/bin:/bin' /bin/sh -e '" + script + "' > '" + log +
                             "' 2>&1 < /dev/null";
    const int status = std::system(call.c_str());  // NOLINT(cert-env33-c,concurrency-mt-unsafe)
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of_file(log)};
  }

 private:
  TemporaryFolder folder_;
};

}  // namespace transillum::test
