// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>

#include "support/temporary_folder.h"
#include "transillum/transillum.h"

namespace transillum::public_headers_test {
namespace {

namespace fs = std::filesystem;

const fs::path folder = fs::path(TRANSILLUM_DATA_DIR) / "../libtransillum/include/transillum";

/// All first groups of a regular expression in a text.
std::set<std::string> matches(const std::string& text, const char* expression) {
  const std::regex regex(expression);
  std::set<std::string> found;
  for (std::sregex_iterator m(text.begin(), text.end(), regex), end; m != end; ++m) {
    found.insert((*m)[1]);
  }
  return found;
}

TEST(PublicHeaders, AreAllIncludedByTransillumH) {
  std::set<std::string> expected;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().filename() != "transillum.h") {
      expected.insert(entry.path().filename());
    }
  }
  EXPECT_GT(expected.size(), 30U);
  EXPECT_EQ(matches(test::read_file(folder / "transillum.h"), R"re(#include "transillum/(.*)")re"),
            expected);
}

TEST(PublicHeaders, IncludeOnlyEachOtherAndTheStandardLibrary) {
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string text = test::read_file(entry.path());
    for (const std::string& header : matches(text, "#include +([^\n]*)")) {
      EXPECT_TRUE(
          std::regex_match(header, std::regex(R"re(<[a-z_]+>|"transillum/[a-z0-9_]+\.h")re")))
          << entry.path() << ": " << header;
    }
  }
}

TEST(PublicHeaders, NameNoCommandLineOption) {
  for (const auto& entry : fs::directory_iterator(folder)) {
    EXPECT_EQ(matches(test::read_file(entry.path()), "[^-\\w](--[a-z][-a-z]+)"),
              std::set<std::string>())
        << entry.path();
  }
}

// decisions/0068-exported-symbols.md
TEST(PublicHeaders, OpenTheExportedNamespace) {
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename(), text = test::read_file(entry.path());
    const auto opened = matches(text, "\n(namespace [^\n]*transillum \\{)\n");
    if (name != "export.h" && name != "transillum.h") {
      EXPECT_EQ(opened, std::set<std::string>{"namespace TRANSILLUM_API transillum {"}) << name;
    }
  }
}

/// GCC hides a class that is declared first in a namespace that is not exported.
TEST(PublicHeaders, DeclareTheirClassesFirst) {
  std::set<std::string> classes;
  for (const auto& entry : fs::directory_iterator(folder)) {
    classes.merge(matches(test::read_file(entry.path()), "\n(?:class|struct) (\\w+)[ ;]"));
  }
  EXPECT_GT(classes.size(), 80U);
  for (const auto& entry : fs::recursive_directory_iterator(folder / "../../src")) {
    if (entry.is_regular_file()) {
      for (const auto& declared :
           matches(test::read_file(entry.path()), "\n(?:class|struct) (\\w+);")) {
        EXPECT_FALSE(classes.contains(declared)) << entry.path() << " declares " << declared;
      }
    }
  }
}

}  // namespace
}  // namespace transillum::public_headers_test
