// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Runs the commands that COOKBOOK.md and README.md print, and compares the output that they show.
// tests/mpi runs the commands of transillum-mpi, tests/viewer the commands of the viewer, and
// tests/python the Python code.
#include <gmock/gmock.h>

#include <memory>
#include <set>
#include <string>

#include "support/printed_commands.h"

namespace transillum::cookbook_test {
namespace {

namespace fs = std::filesystem;
using test::code_blocks;
using test::CodeBlock;
using test::CommandFolder;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const fs::path data = TRANSILLUM_DATA_DIR;
const fs::path readme = data.parent_path() / "README.md";
const fs::path cookbook = data.parent_path() / "libtransillum/COOKBOOK.md";

bool has(const CodeBlock& block, const char* word) {
  return block.text.find(word) != std::string::npos;
}

/// Whether it is run here.
bool is_for_this_program(const CodeBlock& block) {
  return block.language == "sh" && !has(block, "transillum-mpi") &&
         !has(block, "transillum-viewer");
}

/// Runs the commands of one recipe after the other, each recipe in a folder of its own.
class Recipes {
 public:
  void run(const CodeBlock& block) {
    if (block.headings != headings_ || folder_ == nullptr) {
      folder_ = std::make_unique<CommandFolder>(data);
      folder_->add_program("transillum", TRANSILLUM_PROGRAM);
      headings_ = block.headings;
    }
    result_ = folder_->run(block.text);
    ++count_;
    EXPECT_EQ(result_.status, 0) << block.text << result_.output;
  }
  void compare(const CodeBlock& block) const {
    EXPECT_THAT(test::lines_missing(result_.output, block.text), IsEmpty()) << result_.output;
  }
  int count() const { return count_; }

 private:
  std::vector<std::string> headings_;
  std::unique_ptr<CommandFolder> folder_;
  CommandFolder::Result result_{0, {}};
  int count_ = 0;
};

/// @param section heading of a part of the document; empty: all of it
/// @returns the number of blocks of commands
int run_commands(const fs::path& document, const std::string& section) {
  Recipes recipes;
  bool has_output = false;
  for (const CodeBlock& block : code_blocks(document)) {
    if (!section.empty() && (block.headings.size() < 2 || block.headings[1] != section)) {
      continue;
    }
    SCOPED_TRACE(document.filename().string() + ':' + std::to_string(block.line));
    if (is_for_this_program(block)) {
      recipes.run(block);
      has_output = true;
    } else if (block.language == "text" && has_output) {
      recipes.compare(block);
    } else {
      has_output = false;
    }
  }
  return recipes.count();
}

TEST(Cookbook, LightInAScene) { EXPECT_GE(run_commands(cookbook, "Light in a scene"), 6); }
TEST(Cookbook, Accuracy) { EXPECT_GE(run_commands(cookbook, "Accuracy"), 8); }
TEST(Cookbook, WhereLightComesFrom) {
  EXPECT_GE(run_commands(cookbook, "Where light comes from"), 4);
}
TEST(Cookbook, PicturesAndOtherPrograms) {
  EXPECT_GE(run_commands(cookbook, "Pictures and other programs"), 4);
}
TEST(Cookbook, OneDirection) { EXPECT_GE(run_commands(cookbook, "One direction"), 2); }
TEST(Cookbook, LongRuns) { EXPECT_GE(run_commands(cookbook, "Long runs"), 3); }

TEST(Cookbook, HasNoOtherSectionWithCommands) {
  std::set<std::string> sections;
  for (const CodeBlock& block : code_blocks(cookbook)) {
    if (block.language == "sh") {
      ASSERT_EQ(block.headings.size(), 3U) << block.line;
      sections.insert(block.headings[1]);
    }
  }
  EXPECT_THAT(sections, ElementsAre("Accuracy", "Light in a scene", "Long runs", "One direction",
                                    "Pictures and other programs", "Where light comes from"));
}

/// Only jobs of a cluster and what installs packages are printed without being run.
TEST(Cookbook, BlocksThatNoTestRunsAreFew) {
  for (const CodeBlock& block : code_blocks(cookbook)) {
    EXPECT_THAT((std::set<std::string>{"sh", "text", "bash", "cpp", "python"}),
                ::testing::Contains(block.language))
        << block.line;
    if (block.language == "bash") {
      EXPECT_TRUE(has(block, "#SBATCH") || has(block, "srun")) << block.text;
    }
  }
  for (const CodeBlock& block : code_blocks(readme)) {
    if (block.language == "bash") {
      EXPECT_TRUE(has(block, "./demo") || has(block, "apt install")) << block.text;
    }
  }
}

TEST(Readme, CommandsGiveTheOutputThatItShows) { EXPECT_GE(run_commands(readme, ""), 2); }

TEST(PrintedOutput, FitsWithGaps) {
  EXPECT_TRUE(test::fits("abc", "abc"));
  EXPECT_FALSE(test::fits("abcd", "abc"));
  EXPECT_TRUE(test::fits("round 1: 27 patches, 0.18 s", "round 1: 27 patches, …"));
  EXPECT_TRUE(test::fits("took 3 s, 5 MB, done", "took … s, … MB, done"));
  EXPECT_FALSE(test::fits("took 3 s, done", "took … s, … MB, done"));
  EXPECT_FALSE(test::fits("a", "ab…"));
  EXPECT_THAT(test::lines_missing("one\ntwo\n", "two\nthree\n"), ElementsAre("three"));
}

TEST(PrintedOutput, IsReadWithItsHeadings) {
  const test::TemporaryFolder folder;
  const fs::path document = folder.write(
      "a.md", "# Title\n## Part\n```sh\necho 'a b'\n```\n## Other\n### Recipe\n```text\na\n```\n");
  const std::vector<CodeBlock> blocks = code_blocks(document);
  ASSERT_EQ(blocks.size(), 2U);
  EXPECT_THAT(blocks[0].headings, ElementsAre("Title", "Part"));
  EXPECT_EQ(blocks[0].line, 3);
  EXPECT_EQ(blocks[0].text, "echo 'a b'\n");
  EXPECT_THAT(blocks[1].headings, ElementsAre("Title", "Other", "Recipe"));
  EXPECT_EQ(blocks[1].language, "text");
}

TEST(PrintedCommands, RunInAFolderWithDataAndPrograms) {
  const CommandFolder folder(data);
  folder.add_program("says", "echo says");
  EXPECT_EQ(folder.run("says a && test -f data/README.md").output, "says a\n");
  const CommandFolder::Result failed = folder.run("says b >&2\nfalse\nsays c\n");
  EXPECT_EQ(failed.status, 1);
  EXPECT_THAT(failed.output, HasSubstr("says b"));
  EXPECT_THAT(failed.output, ::testing::Not(HasSubstr("says c")));
}

}  // namespace
}  // namespace transillum::cookbook_test
