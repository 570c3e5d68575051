// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Holds the includes of libtransillum and of the viewer to the tables of FOLDERS.md: which
// folder may include which, and which layer may use the public headers of which. A violation is
// reported with file and line. Includes must also form no cycle between files.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "support/temporary_folder.h"

namespace transillum::folders_test {
namespace {

namespace fs = std::filesystem;
using Names = std::set<std::string>;

/// One `#include "…"` of a source file.
struct Include {
  std::string file;  ///< path from the include root
  int line;
  std::string path;  ///< path in the directive
};

/// The includes that the tables of FOLDERS.md allow.
struct Rules {
  std::map<std::string, Names> may_include;         ///< folder → folders
  std::map<std::string, Names> may_use;             ///< layer → layers
  std::map<std::string, std::string> layer_of;      ///< public header → layer
  std::map<std::string, std::string> listed_twice;  ///< public header → its second layer
  Names for_programs;                               ///< headers of src that programs may include
};

/// The words between backquotes in one cell of a table.
Names quoted_words(const std::string& cell) {
  Names words;
  std::size_t begin = 0;
  while ((begin = cell.find('`', begin)) != std::string::npos) {
    const std::size_t end = cell.find('`', begin + 1);
    if (end == std::string::npos) {
      break;
    }
    words.insert(cell.substr(begin + 1, end - begin - 1));
    begin = end + 1;
  }
  return words;
}

std::vector<std::string> cells_of(const std::string& row) {
  std::vector<std::string> cells;
  std::istringstream text(row.substr(1));
  std::string cell;
  while (std::getline(text, cell, '|')) {
    cells.push_back(cell);
  }
  return cells;
}

/// Reads the rows below the heading `heading`, up to the next heading.
std::vector<std::vector<std::string>> table_below(const fs::path& document,
                                                  const std::string& heading) {
  std::ifstream file(document);
  std::vector<std::vector<std::string>> rows;
  std::string line;
  bool inside = false;
  while (std::getline(file, line)) {
    if (line.starts_with("#")) {
      inside = line == heading;
    } else if (inside && line.starts_with("| `")) {
      rows.push_back(cells_of(line));
    }
  }
  return rows;
}

/// The paths of a table "folder, headers".
Names read_headers_for_programs(const fs::path& document) {
  Names paths;
  for (const auto& row : table_below(document, "## Headers of src for programs")) {
    for (const std::string& header : quoted_words(row.at(1))) {
      paths.insert(*quoted_words(row.at(0)).begin() + "/" + header);
    }
  }
  return paths;
}

/// @param folders heading of a table "folder, what it is, may include"
Rules read_rules(const fs::path& document, const std::string& folders) {
  Rules rules;
  for (const auto& row : table_below(document, folders)) {
    rules.may_include[*quoted_words(row.at(0)).begin()] = quoted_words(row.at(2));
  }
  for (const auto& row : table_below(document, "## Public headers")) {
    const std::string layer = *quoted_words(row.at(0)).begin();
    for (const std::string& header : quoted_words(row.at(1))) {
      if (!rules.layer_of.try_emplace(header, layer).second) {
        rules.listed_twice[header] = layer;
      }
    }
    rules.may_use[layer] = quoted_words(row.at(2));
    rules.may_use[layer].insert(layer);
  }
  return rules;
}

std::vector<Include> includes_below(const fs::path& root) {
  std::vector<Include> includes;
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root)) {
    if (entry.path().extension() == ".h" || entry.path().extension() == ".cpp") {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files) {
    std::ifstream stream(file);
    std::string text;
    for (int line = 1; std::getline(stream, text); ++line) {
      constexpr std::string_view start = "#include \"";
      if (text.starts_with(start)) {
        const std::string path = text.substr(start.size(), text.rfind('"') - start.size());
        includes.push_back({file.lexically_relative(root).generic_string(), line, path});
      }
    }
  }
  return includes;
}

std::string folder_of(const std::string& file) { return fs::path(file).parent_path().string(); }

std::string place(const Include& include) {
  return include.file + ":" + std::to_string(include.line) + ": includes \"" + include.path + "\"";
}

/// Every include of another folder's private headers that its row does not allow.
std::vector<std::string> folder_violations(const std::vector<Include>& includes,
                                           const Rules& rules) {
  std::vector<std::string> found;
  for (const Include& include : includes) {
    if (include.path.starts_with("transillum/") || rules.for_programs.contains(include.path)) {
      continue;
    }
    const std::string from = folder_of(include.file), to = folder_of(include.path);
    const auto row = rules.may_include.find(from);
    if (row == rules.may_include.end()) {
      found.push_back(place(include) + ": folder " + from + " is not in the table");
    } else if (from != to && !row->second.contains(to)) {
      found.push_back(fmt::format("{}: {} may not include {}", place(include), from, to));
    }
  }
  return found;
}

/// Every use of a public header whose layer the including layer may not use. The layer of a file in
/// src/ is its first folder; the layer of a public header is in the table.
std::vector<std::string> layer_violations(const std::vector<Include>& includes,
                                          const Rules& rules) {
  std::vector<std::string> found;
  for (const Include& include : includes) {
    if (!include.path.starts_with("transillum/") || include.file == "transillum/transillum.h") {
      continue;
    }
    const auto used = rules.layer_of.find(include.path.substr(11));
    if (used == rules.layer_of.end()) {
      found.push_back(place(include) + ": this public header is not in the table");
      continue;
    }
    std::string layer = include.file.substr(0, include.file.find('/'));
    if (layer == "transillum") {
      const auto own = rules.layer_of.find(include.file.substr(11));
      layer = own == rules.layer_of.end() ? "unknown layer" : own->second;
    }
    const auto row = rules.may_use.find(layer);
    if (row == rules.may_use.end() || !row->second.contains(used->second)) {
      found.push_back(place(include) + ": " + layer + " may not use " + used->second);
    }
  }
  return found;
}

/// Finds cycles between units; a unit is a header together with its source file.
class CycleSearch {
 public:
  explicit CycleSearch(const std::vector<Include>& includes) {
    for (const Include& include : includes) {
      const std::string from = unit_of(include.file), to = unit_of(include.path);
      if (from != to) {
        edges_[from].emplace(to, place(include));
      }
    }
  }
  std::vector<std::string> run() {
    for (const auto& [unit, edges] : edges_) {
      visit(unit);
    }
    return found_;
  }

 private:
  static std::string unit_of(const std::string& file) {
    return fs::path(file).replace_extension().string();
  }
  void visit(const std::string& unit) {
    if (done_.contains(unit)) {
      return;
    }
    path_.push_back(unit);
    if (const auto edges = edges_.find(unit); edges != edges_.end()) {
      for (const auto& [next, include] : edges->second) {
        if (std::find(path_.begin(), path_.end(), next) != path_.end()) {
          found_.push_back(fmt::format("{} closes a cycle through {}", include, next));
        } else {
          visit(next);
        }
      }
    }
    path_.pop_back();
    done_.insert(unit);
  }

  std::map<std::string, std::map<std::string, std::string>> edges_;
  std::vector<std::string> path_, found_;
  Names done_;
};

Names folders_with_sources(const fs::path& root) {
  Names folders;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root)) {
    if (entry.path().extension() == ".cpp" || entry.path().extension() == ".h") {
      folders.insert(entry.path().lexically_relative(root).parent_path().generic_string());
    }
  }
  return folders;
}

Names keys_of(const std::map<std::string, Names>& map) {
  Names keys;
  for (const auto& [key, value] : map) {
    keys.insert(key);
  }
  return keys;
}

const fs::path repository = fs::path(TRANSILLUM_DATA_DIR).parent_path();
const fs::path document = repository / "libtransillum/FOLDERS.md";
const fs::path sources = repository / "libtransillum/src";
const fs::path headers = repository / "libtransillum/include";
const fs::path viewer = repository / "viewer";

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

TEST(Folders, OfTheLibraryIncludeOnlyWhatTheTableAllows) {
  const Rules rules = read_rules(document, "## Folders of libtransillum/src");
  EXPECT_EQ(keys_of(rules.may_include), folders_with_sources(sources));
  EXPECT_THAT(folder_violations(includes_below(sources), rules), IsEmpty());
}

TEST(Folders, OfTheViewerIncludeOnlyWhatTheTableAllows) {
  Rules rules = read_rules(document, "## Folders of viewer");
  rules.for_programs = read_headers_for_programs(document);
  EXPECT_EQ(keys_of(rules.may_include), folders_with_sources(viewer));
  EXPECT_THAT(folder_violations(includes_below(viewer), rules), IsEmpty());
}

TEST(Folders, PublicHeadersAreUsedByTheLayersThatTheTableAllows) {
  const Rules rules = read_rules(document, "## Folders of libtransillum/src");
  EXPECT_THAT(rules.listed_twice, IsEmpty());
  Names listed, present;
  for (const auto& [header, layer] : rules.layer_of) {
    listed.insert(header);
  }
  for (const fs::directory_entry& entry : fs::directory_iterator(headers / "transillum")) {
    present.insert(entry.path().filename().string());
  }
  present.erase("transillum.h");
  EXPECT_EQ(listed, present);
  EXPECT_THAT(layer_violations(includes_below(sources), rules), IsEmpty());
  EXPECT_THAT(layer_violations(includes_below(headers), rules), IsEmpty());
}

TEST(Folders, FilesIncludeOneAnotherWithoutCycles) {
  for (const fs::path& root : {sources, headers, viewer}) {
    EXPECT_THAT(CycleSearch(includes_below(root)).run(), IsEmpty()) << root;
  }
}

TEST(Folders, ProgramsUsePublicHeadersAndThoseOfTheTable) {
  const Names allowed = read_headers_for_programs(document);
  Names used;
  for (const fs::path& folder :
       {repository / "libtransillum/cli", repository / "libtransillum/mpi",
        repository / "libtransillum/manual", repository / "libtransillum/python", viewer}) {
    for (const Include& include : includes_below(folder)) {
      if (allowed.contains(include.path)) {
        used.insert(include.path);
      } else if (!include.path.starts_with("transillum/")) {
        EXPECT_FALSE(fs::exists(sources / include.path)) << place(include);
      }
    }
  }
  EXPECT_EQ(used, allowed);
}

/// A file that a command left in the root of the repository would be committed with the next
/// change.
TEST(Folders, TheRootHasNoOtherFiles) {
  const Names expected{
      "CMakeLists.txt", "CMakePresets.json", "README.md", "CHANGELOG.md", "CONTRIBUTING.md",
      "CITATION.cff",   "LICENSE",           "check",     "demo"};
  Names found;
  for (const fs::directory_entry& entry : fs::directory_iterator(repository)) {
    const std::string name = entry.path().filename().string();
    if (entry.is_regular_file() && !name.starts_with('.') && name != "demo.png") {
      found.insert(name);
    }
  }
  EXPECT_EQ(found, expected);
}

/// Two classes of one name are one for the linker, which keeps one destructor for both.
TEST(Folders, TypesOfTheLibraryHaveOneDefinition) {
  static const std::regex definition(
      R"((?:class|struct) (?:\[\[.*\]\] )?(?:alignas\(\w+\) )?(\w+)(?: final)?(?: : .*)? \{)");
  std::map<std::string, Names> files_of;
  for (const fs::path& root : {sources, headers}) {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root)) {
      std::ifstream in(entry.path());
      bool has_linkage = true;
      for (std::string line; std::getline(in, line);) {
        std::smatch match;
        if (line == "namespace {") {
          has_linkage = false;
        } else if (line == "}  // namespace") {
          has_linkage = true;
        } else if (has_linkage && std::regex_match(line, match, definition)) {
          files_of[match[1]].insert(entry.path().lexically_relative(repository).string());
        }
      }
    }
  }
  EXPECT_GT(files_of.size(), 300u);
  for (const auto& [name, files] : files_of) {
    EXPECT_THAT(files, SizeIs(1)) << name;
  }
}

/// A tree of three folders with one include against the table, one cycle and one public header.
class PlantedIncludes : public ::testing::Test {
 protected:
  void SetUp() override {
    write(
        "rules.md",
        "## Folders of libtransillum/src\n\n| folder | what it is | may include |\n|---|---|---|\n"
        "| `low` | the base | |\n| `middle/part` | uses it | `low` |\n"
        "## Public headers\n\n| layer | headers | may use |\n|---|---|---|\n"
        "| `low` | `a.h` | |\n| `middle` | `b.h` | `low` |\n");
    write("src/low/base.h", "#pragma once\n#include \"transillum/a.h\"\n");
    write("src/middle/part/user.h", "#pragma once\n#include \"low/base.h\"\n");
    rules_ = read_rules(folder_.path() / "rules.md", "## Folders of libtransillum/src");
  }
  void write(const std::string& name, const std::string& text) {
    const fs::path file = folder_.path() / name;
    fs::create_directories(file.parent_path());
    std::ofstream(file) << text;
  }
  std::vector<Include> includes() const { return includes_below(folder_.path() / "src"); }

  test::TemporaryFolder folder_;
  Rules rules_;
};

TEST_F(PlantedIncludes, AreNotReportedInAValidTree) {
  EXPECT_THAT(folder_violations(includes(), rules_), IsEmpty());
  EXPECT_THAT(layer_violations(includes(), rules_), IsEmpty());
  EXPECT_THAT(CycleSearch(includes()).run(), IsEmpty());
}

TEST_F(PlantedIncludes, AreReportedWithFileAndLine) {
  write("src/low/wrong.cpp", "// one\n// two\n#include \"middle/part/user.h\"\n");
  EXPECT_THAT(folder_violations(includes(), rules_),
              ElementsAre("low/wrong.cpp:3: includes \"middle/part/user.h\": low may not include "
                          "middle/part"));
}

TEST_F(PlantedIncludes, OfAHigherLayersPublicHeaderAreReported) {
  write("src/low/wrong.cpp", "#include \"transillum/b.h\"\n");
  EXPECT_THAT(layer_violations(includes(), rules_),
              ElementsAre("low/wrong.cpp:1: includes \"transillum/b.h\": low may not use middle"));
}

TEST_F(PlantedIncludes, InFoldersThatTheTableLacksAreReported) {
  write("src/new/file.cpp", "#include \"low/base.h\"\n");
  EXPECT_THAT(folder_violations(includes(), rules_),
              ElementsAre(HasSubstr("new is not in the table")));
}

TEST_F(PlantedIncludes, ThatCloseACycleAreReported) {
  write("src/low/one.h", "#include \"low/two.h\"\n");
  write("src/low/two.cpp", "#include \"low/one.h\"\n");
  EXPECT_THAT(CycleSearch(includes()).run(), ElementsAre(HasSubstr("closes a cycle through")));
}

}  // namespace
}  // namespace transillum::folders_test
