// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Checks the documents (*.md) of the source tree: relative links lead to existing files and
// headings, every decision is in the index and has the form of all, decisions that sources name
// exist, and the C++ code of the cookbook is in an example. cookbook_test.cpp runs commands.
#include <gmock/gmock.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>
#include "support/temporary_folder.h"

namespace transillum::documents_test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

fs::path source_folder() { return fs::path(TRANSILLUM_DATA_DIR).parent_path(); }

/// All *.md files, without build folders and hidden ones.
std::vector<fs::path> documents() {
  std::vector<fs::path> found;
  for (auto entry = fs::recursive_directory_iterator(source_folder());
       entry != fs::recursive_directory_iterator(); ++entry) {
    const std::string name = entry->path().filename().string();
    if (entry->is_directory() && (name == "build" || name.starts_with("."))) {
      entry.disable_recursion_pending();
    } else if (entry->path().extension() == ".md") {
      found.push_back(entry->path());
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

/// The lines of a document outside fenced code blocks.
std::vector<std::string> prose_lines(const fs::path& document) {
  std::istringstream text(test::read_file(document));
  std::vector<std::string> lines;
  bool in_code = false;
  for (std::string line; std::getline(text, line);) {
    if (line.starts_with("```")) {
      in_code = !in_code;
    }
    lines.push_back(in_code ? "" : line);
  }
  return lines;
}

/// The anchor that a heading gets when a document is shown as a web page: lower case, blanks as
/// hyphens, punctuation dropped.
std::string anchor_of(const std::string& heading) {
  std::string anchor;
  for (const char c : heading.substr(heading.find_first_not_of("# "))) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == ' ') {
      anchor += '-';
    } else if (byte >= 0x80 || std::isalnum(byte) || c == '-' || c == '_') {
      anchor += static_cast<char>(std::tolower(byte));
    }
  }
  return anchor;
}

std::set<std::string> anchors(const fs::path& document) {
  std::set<std::string> found;
  for (const std::string& line : prose_lines(document)) {
    if (line.starts_with("#")) {
      found.insert(anchor_of(line));
    }
  }
  return found;
}

/// Whether a relative link, as written in `document`, leads somewhere.
bool leads_somewhere(const fs::path& document, const std::string& link) {
  const std::size_t hash = std::min(link.find('#'), link.size());
  const fs::path target =
      hash == 0 ? document : document.parent_path() / fs::path(link.substr(0, hash));
  if (!fs::exists(target)) {
    return false;
  }
  return hash == link.size() || target.extension() != ".md" ||
         anchors(target).contains(link.substr(hash + 1));
}

TEST(Documents, HaveNoBrokenLinks) {
  // [text](target); code between backquotes inside the text is fine.
  const std::regex link_pattern(R"(\]\(([^()\s]+)\))");
  std::vector<std::string> broken;
  std::size_t count = 0;
  for (const fs::path& document : documents()) {
    const std::vector<std::string> lines = prose_lines(document);
    for (std::size_t k = 0; k < lines.size(); ++k) {
      for (std::sregex_iterator match(lines[k].begin(), lines[k].end(), link_pattern), end;
           match != end; ++match) {
        const std::string link = (*match)[1];
        if (link.find("://") != std::string::npos) {
          continue;
        }
        ++count;
        if (!leads_somewhere(document, link)) {
          broken.push_back(document.lexically_relative(source_folder()).string() + ":" +
                           std::to_string(k + 1) + ": " + link);
        }
      }
    }
  }
  EXPECT_THAT(broken, IsEmpty());
  EXPECT_GT(count, 100U);
}

TEST(Documents, TheIndexOfDecisionsIsComplete) {
  const fs::path folder = source_folder() / "libtransillum/decisions";
  const std::string index = test::read_file(folder / "README.md");
  int highest = 0;
  std::set<int> numbers;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name == "README.md") {
      continue;
    }
    const int number = std::stoi(name.substr(0, 4));
    const std::string title = "# " + std::to_string(number) + ". ";
    EXPECT_THAT(index, HasSubstr("| [" + std::to_string(number) + "](" + name + ") |"));
    EXPECT_TRUE(test::read_file(entry.path()).starts_with(title)) << name;
    EXPECT_TRUE(numbers.insert(number).second) << "two decisions have the number " << number;
    highest = std::max(highest, number);
  }
  const std::string gaps = index.substr(index.find("## Numbers without a note"));
  for (int number = 1; number < highest; ++number) {
    if (!numbers.contains(number)) {
      EXPECT_TRUE(std::regex_search(gaps, std::regex("\\b" + std::to_string(number) + "\\b")))
          << "number " << number << " is not explained";
    }
  }
}

/// Title, question, decision, then anything; parts of a note are paragraphs, not headings.
TEST(Documents, DecisionsHaveOneForm) {
  for (const fs::directory_entry& entry :
       fs::directory_iterator(source_folder() / "libtransillum/decisions")) {
    const std::string name = entry.path().filename().string();
    if (name == "README.md") {
      continue;
    }
    const std::string text = test::read_file(entry.path());
    const std::size_t question = text.find("\n**Question.** "),
                      decision = text.find("\n**Decision");
    EXPECT_NE(question, std::string::npos) << name << " asks no question";
    EXPECT_NE(decision, std::string::npos) << name << " decides nothing";
    EXPECT_LT(question, decision) << name;
    EXPECT_EQ(text.find("\n## "), std::string::npos) << name << " has headings";
    EXPECT_EQ(text.find("\nStatus:"), std::string::npos) << name << ": the word is State";
  }
}

/// Comments of the sources that refer to a decision.
TEST(Documents, DecisionsNamedInSourcesExist) {
  const std::regex reference(R"(decisions/\d{4}[a-z0-9-]*(\.md)?)");
  std::vector<std::string> missing;
  std::size_t count = 0;
  for (const char* folder : {"libtransillum", "viewer", "tests"}) {
    for (const fs::directory_entry& entry :
         fs::recursive_directory_iterator(source_folder() / folder)) {
      const fs::path extension = entry.path().extension();
      if (extension != ".h" && extension != ".cpp") {
        continue;
      }
      const std::string text = test::read_file(entry.path());
      for (std::sregex_iterator match(text.begin(), text.end(), reference), end; match != end;
           ++match) {
        ++count;
        if (!fs::is_regular_file(source_folder() / "libtransillum" / match->str())) {
          missing.push_back(entry.path().filename().string() + ": " + match->str());
        }
      }
    }
  }
  EXPECT_THAT(missing, IsEmpty());
  EXPECT_GT(count, 5U);
}

TEST(Documents, CppOfTheCookbookIsInAnExample) {
  std::string examples;
  for (const fs::directory_entry& entry :
       fs::directory_iterator(source_folder() / "libtransillum/examples")) {
    if (entry.path().extension() == ".cpp") {
      examples += test::read_file(entry.path());
    }
  }
  const std::string cookbook = test::read_file(source_folder() / "libtransillum/COOKBOOK.md");
  const std::string open = "```cpp\n";
  int count = 0;
  for (std::size_t begin = cookbook.find(open); begin != std::string::npos;
       begin = cookbook.find(open, begin)) {
    begin += open.size();
    const std::string code = cookbook.substr(begin, cookbook.find("```", begin) - begin);
    EXPECT_THAT(examples, HasSubstr(code));
    ++count;
  }
  EXPECT_GE(count, 1);
}

}  // namespace
}  // namespace transillum::documents_test
