// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Checks six rules of plain English in comments, string literals, lessons and documents:
//   1. "that of" and "those of" have their noun earlier in the same sentence, in a parallel phrase:
//      "the area of the patch …, that of the piece", "its area …, that of the piece".
//   2. No comment, help text or message begins with Of, Those, As, It or What. Questions may; so
//      may names of at most six words without a full stop, except in help texts. After
//      `@param NAME` any word may follow, since the name is the noun.
//   3. "0:", "null:", "none:", "empty:" and "unset:" are followed by a phrase of three words.
//   4. Words that are not the field's terms are not used.
//   5. A paragraph has at most three sentences; lines have at most 100 characters.
//   6. Names of types, by their declarations, do not use part, run, figure, share, group and round
//      for what has another name in GLOSSARY.md.
// Rules 1 and 4 apply everywhere, rule 6 to C++, rules 2 and 3 to sources and lessons. Rule 2 does
// not apply to strings of tests, which quote parts of messages. Rule 5 applies to documents except
// decisions: these are records of measurements, written once, one paragraph a line.
#include <gmock/gmock.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "support/passages.h"

namespace transillum::english_test {
namespace {

namespace fs = std::filesystem;
using test::is_word;
using test::Kind;
using test::paragraphs_in;
using test::Passage;
using test::SourceReader;
using test::trimmed;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

const fs::path repository = fs::path(TRANSILLUM_DATA_DIR).parent_path();

/// A word that is not used, and the field's term for it.
struct Term {
  const char* pattern;  ///< regular expression, in lower case
  const char* rare;     ///< part of every match: it is sought first, since that is fast
  const char* instead;
};

const std::vector<Term> terms{
    {R"(\bh(ang|angs|anging|ung) together\b)", " together", "be connected"},
    {R"(\b(go|goes|going|gone|went) on\b)", " on", "continue, resume"},
    {R"(\b(leave|leaves|leaving|left)( \w+){0,2} out\b)", " out", "omit"},
    {R"(\banew\b)", "anew", "again, re-"},
    {R"(\bwithout a word\b)", "a word", "silently"},
    {R"(\beven directions\b)", "even dir", "evenly spread directions"},
};

/// The declaration of a type, or of the parameter of a template, whose name has a word of the
/// glossary in another meaning.
const std::regex misnamed_type(
    R"(\b(struct|class|using) (Parts?|Figures?|Shares|Groups?|Rounds?|Part[A-Z]\w*|)"
    R"(\w*(PartsBy|OfParts|Figures|FigureKind|FigureValues)|(Linear|Surface|Solver)Parts?|)"
    R"((Back|Patch)Share|KeyGroup|PassRounds|RunInput)(?!\w))");

/// A violation that stays.
struct Exception {
  const char* file;
  int rule;
  const char* words;  ///< part of what follows the place in the report
  const char* reason;
};

const std::vector<Exception> exceptions{
    {"tests/unit/english_test.cpp", 0, "", "quotes what the rules forbid"},
};

// ---- The rules --------------------------------------------------------------------------------

/// A place where a rule is broken.
struct Violation {
  int line = 0;
  int rule = 0;
  std::string words;

  std::string text() const {
    return std::to_string(line) + ": rule " + std::to_string(rule) + ": " + words;
  }
};

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// Whether a byte continues a character of UTF-8.
bool continues_character(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

/// Up to 60 bytes of a passage, for a report.
std::string excerpt(const Passage& passage, std::size_t begin) {
  std::size_t end = std::min(begin + 60, passage.text.size());
  while (end < passage.text.size() && continues_character(passage.text[end])) {
    --end;
  }
  return std::string(trimmed(std::string_view(passage.text).substr(begin, end - begin)));
}

/// Where the sentence begins that contains the character `at`.
std::size_t sentence_begin(const std::string& text, std::size_t at) {
  for (std::size_t i = at; i > 0; --i) {
    const char before = text[i - 1];
    const bool ends = (before == '.' || before == '?' || before == '!') && text[i] == ' ';
    if (ends || before == '\n' || before == '@') {
      return i;
    }
  }
  return 0;
}

/// Whether the words before "that of" or "those of" have a noun for it: in "NOUN of", "its NOUN" or
/// "the patch's NOUN"; for "those of", one in the plural.
bool has_noun(const std::string& before, bool plural) {
  static const std::regex parallel(R"(\b([a-z]+) of\b|(?:\b(?:its|their)|'s) ([a-z]+)\b)");
  static const std::set<std::string> not_nouns{
      "that", "those", "out",  "because", "instead", "consist",  "each", "all",  "one", "both",
      "some", "most",  "none", "any",     "part",    "consists", "this", "many", "two", "half"};
  for (std::sregex_iterator match(before.begin(), before.end(), parallel), end; match != end;
       ++match) {
    const std::string noun = (*match)[1].matched ? match->str(1) : match->str(2);
    if (!not_nouns.contains(noun) && (!plural || noun.ends_with('s'))) {
      return true;
    }
  }
  return false;
}

void check_nouns(const Passage& passage, const std::string& text, std::vector<Violation>& found) {
  for (const char* words : {"that of", "those of"}) {
    const std::string_view pattern = words;
    for (std::size_t at = text.find(words); at != std::string::npos;
         at = text.find(words, at + 1)) {
      const std::size_t end = at + pattern.size();
      const bool whole =
          (at == 0 || !is_word(text[at - 1])) && (end == text.size() || !is_word(text[end]));
      const std::size_t begin = sentence_begin(text, at);
      if (whole && !has_noun(text.substr(begin, at - begin), pattern == "those of")) {
        found.push_back({passage.lines[at], 1, excerpt(passage, at)});
      }
    }
  }
}

/// Whether a passage may be a name, such as a heading or the label of a button.
bool is_name(const std::string& text) {
  constexpr std::ptrdiff_t most_words = 6;
  return std::count(text.begin(), text.end(), ' ') < most_words && !text.ends_with('.');
}

void check_beginning(const Passage& passage, const std::string& text, bool help,
                     std::vector<Violation>& found) {
  static const std::regex pronoun("(?:of|those|as|it|what) [^ ]+( )?");
  std::smatch match;
  if (!std::regex_search(text, match, pronoun, std::regex_constants::match_continuous) ||
      (passage.kind == Kind::string && !match[1].matched)) {
    return;
  }
  const bool capital = std::isupper(static_cast<unsigned char>(passage.text.front())) != 0;
  const bool question = text.find('?') < text.find(". ");
  const bool name = passage.kind == Kind::string && !help && is_name(text);
  if (!question && !name && (capital || help || passage.kind == Kind::comment)) {
    found.push_back({passage.lines.front(), 2, excerpt(passage, 0)});
  }
}

void check_shorthand(const Passage& passage, const std::string& text,
                     std::vector<Violation>& found) {
  static const std::regex value(R"((^|[;,.] |\(|\n)`?(null|nullptr|0|none|empty|unset)`?: )");
  if (text.find(": ") == std::string::npos) {
    return;
  }
  for (std::sregex_iterator match(text.begin(), text.end(), value), end; match != end; ++match) {
    const std::size_t at = static_cast<std::size_t>(match->position(2));
    const std::size_t begin = static_cast<std::size_t>(match->position() + match->length());
    std::istringstream phrase(text.substr(begin, text.find_first_of(",;.)\n", begin) - begin));
    const std::vector<std::string> words{std::istream_iterator<std::string>(phrase), {}};
    if (words.size() < 3 || words[0] == "it" || words[0] == "none") {
      found.push_back({passage.lines[at], 3, excerpt(passage, at)});
    }
  }
}

void check_terms(const Passage& passage, const std::string& text, std::vector<Violation>& found) {
  static const std::vector<std::regex> patterns = [] {
    std::vector<std::regex> made;
    for (const Term& term : terms) {
      made.emplace_back(term.pattern);
    }
    return made;
  }();
  for (std::size_t k = 0; k < terms.size(); ++k) {
    if (text.find(terms[k].rare) == std::string::npos) {
      continue;
    }
    for (std::sregex_iterator match(text.begin(), text.end(), patterns[k]), end; match != end;
         ++match) {
      const std::size_t at = static_cast<std::size_t>(match->position());
      found.push_back({passage.lines[at], 4, "\"" + match->str() + "\": say " + terms[k].instead});
    }
  }
}

void check_paragraph(const Passage& passage, std::vector<Violation>& found) {
  static const std::regex sentence_end(R"~([.!?][)"*_`]* +[(\["*_`]*[A-Z])~");
  // A bold label at the beginning is a heading.
  static const std::regex label(R"(^\*\*[^*]+\.\*\* )");
  const std::string text = std::regex_replace(passage.text, label, "");
  const auto ends = std::distance(std::sregex_iterator(text.begin(), text.end(), sentence_end),
                                  std::sregex_iterator());
  if (ends > 2) {
    found.push_back({passage.lines.front(), 5,
                     std::to_string(ends + 1) + " sentences: " + excerpt(passage, 0)});
  }
}

/// Lines of more than 100 characters, without targets of links; tables, headings and code may be
/// longer, and so may one long word.
void check_width(const std::string& document, std::vector<Violation>& found) {
  static const std::regex target(R"(\]\([^)]*\))");
  std::istringstream lines(document);
  bool in_code = false;
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    const bool fence = trimmed(line).starts_with("```");
    in_code = in_code != fence;
    if (in_code || line.size() <= 100 || line[0] == '|' || line[0] == '#' ||
        line.starts_with("    ")) {
      continue;
    }
    const std::string shown = std::regex_replace(line, target, "]");
    const auto width =
        std::count_if(shown.begin(), shown.end(), [](char c) { return !continues_character(c); });
    if (width > 100 && trimmed(shown).find(' ') != std::string_view::npos) {
      found.push_back({number, 5, std::to_string(width) + " characters"});
    }
  }
}

/// Which rules hold for a file, and how it is read.
struct FileType {
  bool document = false;            ///< Markdown; otherwise a source
  std::string comment_mark = "//";  ///< what comments of a source begin with, if it may have any
  bool messages = true;             ///< rule 2 applies to strings
  bool help = false;                ///< rule 2 applies to strings that begin in lower case, too
  bool decision = false;            ///< rule 5 does not apply
};

/// Finds names of types that use a word of the glossary in another meaning.
void check_types(const std::string& content, std::vector<Violation>& found) {
  std::istringstream lines(content);
  std::string line;
  std::smatch match;
  for (int number = 1; std::getline(lines, line); ++number) {
    if (std::regex_search(line, match, misnamed_type)) {
      found.push_back({number, 6, match.str(2)});
    }
  }
}

void check_source(const std::string& content, const FileType& type, std::vector<Violation>& found) {
  if (type.comment_mark == "//") {
    check_types(content, found);
  }
  for (const Passage& passage : SourceReader(content, type.comment_mark).run()) {
    const std::string text = lower(passage.text);
    check_nouns(passage, text, found);
    if (passage.kind == Kind::comment || type.messages) {
      check_beginning(passage, text, type.help, found);
    }
    check_shorthand(passage, text, found);
    check_terms(passage, text, found);
  }
}

void check_document(const std::string& content, const FileType& type,
                    std::vector<Violation>& found) {
  for (const Passage& passage : paragraphs_in(content)) {
    const std::string text = lower(passage.text);
    check_nouns(passage, text, found);
    check_terms(passage, text, found);
    if (!type.decision) {
      check_paragraph(passage, found);
    }
  }
  if (!type.decision) {
    check_width(content, found);
  }
}

std::vector<Violation> violations_in(const std::string& content, const FileType& type) {
  std::vector<Violation> found;
  if (type.document) {
    check_document(content, type, found);
  } else {
    check_source(content, type, found);
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Violation& a, const Violation& b) { return a.line < b.line; });
  return found;
}

// ---- The repository ---------------------------------------------------------------------------

/// Files whose string literals are help texts.
bool is_help(const std::string& name) {
  return name.starts_with("libtransillum/cli/") || name.ends_with("option_table.cpp");
}

/// How the file is read; nothing if it is not.
std::optional<FileType> type_of(const fs::path& file, const std::string& name) {
  const std::string extension = file.extension().string();
  FileType type;
  if (extension == ".md") {
    type.document = true;
    type.decision = name.starts_with("libtransillum/decisions/0");
    return type;
  }
  if (extension == ".py" || extension == ".pyi" || extension == ".cmake" ||
      file.filename() == "CMakeLists.txt") {
    type.comment_mark = "#";
  } else if (extension == ".json" && name.starts_with("data/lessons/")) {
    type.comment_mark.clear();
  } else if (extension != ".h" && extension != ".cpp") {
    return std::nullopt;
  }
  type.messages = !name.starts_with("tests/");
  type.help = is_help(name);
  return type;
}

/// All files of the repository, without build folders and hidden ones.
std::vector<fs::path> files_of_repository() {
  std::vector<fs::path> files;
  for (auto entry = fs::recursive_directory_iterator(repository);
       entry != fs::recursive_directory_iterator(); ++entry) {
    const std::string name = entry->path().filename().string();
    if (entry->is_directory() &&
        (name == "build" || name == "node_modules" || name.starts_with("."))) {
      entry.disable_recursion_pending();
    } else if (entry->is_regular_file()) {
      files.push_back(entry->path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// The exception for a violation; -1: there is none in the list.
int exception_for(const std::string& name, const Violation& violation) {
  for (std::size_t i = 0; i < exceptions.size(); ++i) {
    const Exception& exception = exceptions[i];
    if (name == exception.file && (exception.rule == 0 || exception.rule == violation.rule) &&
        violation.words.find(exception.words) != std::string::npos) {
      return static_cast<int>(i);
    }
  }
  return -1;
}

TEST(English, FollowsSixRules) {
  std::ostringstream list;
  int count = 0;
  std::set<int> used;
  for (const fs::path& file : files_of_repository()) {
    const std::string name = file.lexically_relative(repository).generic_string();
    const std::optional<FileType> type = type_of(file, name);
    if (!type) {
      continue;
    }
    std::ostringstream content;
    content << std::ifstream(file, std::ios::binary).rdbuf();
    for (const Violation& violation : violations_in(content.str(), *type)) {
      const int exception = exception_for(name, violation);
      used.insert(exception);
      if (exception < 0) {
        list << name << ':' << violation.text() << '\n';
        ++count;
      }
    }
  }
  EXPECT_EQ(count, 0) << list.str();
  for (std::size_t i = 0; i < exceptions.size(); ++i) {
    EXPECT_TRUE(used.contains(static_cast<int>(i)))
        << "exception " << i << " for " << exceptions[i].file << " is no longer needed";
  }
}

/// The violations in a text, as they are reported after the file's name.
std::vector<std::string> reports(const std::string& content, const FileType& type = {}) {
  std::vector<std::string> found;
  for (const Violation& violation : violations_in(content, type)) {
    found.push_back(violation.text());
  }
  return found;
}

TEST(English, ReadsCommentsAndStrings) {
  const std::string source =
      "// One comment in\n"
      "// two lines, goes on.\n"
      "int a = '\"';  ///< a trailing one\n"
      "               ///< goes on\n"
      "int b = 1'000;\n"
      "const char* c = \"one \\\"literal\\\" goes \"\n"
      "                \"on\";\n"
      "/* A block goes\n"
      "   on */ auto d = R\"(raw\n"
      "goes on)\";\n"
      "goes(on); goes on;\n";
  EXPECT_THAT(reports(source), ElementsAre("2: rule 4: \"goes on\": say continue, resume",
                                           "4: rule 4: \"goes on\": say continue, resume",
                                           "6: rule 4: \"goes on\": say continue, resume",
                                           "8: rule 4: \"goes on\": say continue, resume",
                                           "10: rule 4: \"goes on\": say continue, resume"));
  EXPECT_THAT(
      reports("# It runs.\nx = 'goes on'\n\"\"\"What a\nmodule is.\"\"\"\n", {.comment_mark = "#"}),
      ElementsAre("1: rule 2: It runs.", "2: rule 4: \"goes on\": say continue, resume",
                  "3: rule 2: What a module is."));
}

TEST(English, NounsOfThatAndThoseAreFound) {
  EXPECT_THAT(
      reports("// Applies those of materials_.\n"
              "int a;  ///< larger than that of b\n"
              "// The area of a piece. That of its patch is larger.\n"
              "int b;  ///< its rows, with that of b\n"
              "// Reads the row of a file, then those of others.\n"),
      ElementsAre("1: rule 1: those of materials_.", "2: rule 1: that of b",
                  "3: rule 1: That of its patch is larger.", "5: rule 1: those of others."));
  EXPECT_THAT(reports("// The area of a piece is less than that of its patch.\n"
                      "int a;  ///< the patch's area over that of b\n"
                      "// The rows of a file, then those of others.\n"),
              IsEmpty());
}

TEST(English, PronounsThatBeginAreFound) {
  EXPECT_THAT(reports("/// What it does.\n"
                      "int a;  ///< of the file\n"
                      "int b;  ///< As given.\n"
                      "tip(\"It opens the scene.\");\n"
                      "tip(\"of {} patches, {} are seen\");\n"),
              ElementsAre("1: rule 2: What it does.", "2: rule 2: of the file",
                          "3: rule 2: As given.", "4: rule 2: It opens the scene."));
  EXPECT_THAT(reports("option(\"what the map shows\");\n", {.help = true}),
              ElementsAre("1: rule 2: what the map shows"));
  EXPECT_THAT(reports("name(\"What lights the selection\");\n"
                      "ask(\"What does patch i see of patch j?\");\n"
                      "/// @param size of a page\n"),
              IsEmpty());
}

TEST(English, ValuesWithoutAPhraseAreFound) {
  EXPECT_THAT(reports("int a;  ///< a limit; 0: none\n"
                      "int b;  ///< empty: it has none of them\n"
                      "// null: the default, if there is one\n"),
              ElementsAre("1: rule 3: 0: none", "2: rule 3: empty: it has none of them",
                          "3: rule 3: null: the default, if there is one"));
  EXPECT_THAT(reports("int a;  ///< a limit; 0: nothing is limited\n"
                      "fail(\"face 0: no corners\");\n"),
              IsEmpty());
}

TEST(English, OtherTermsAreFound) {
  EXPECT_THAT(reports("// Parts that hang together are left out, without a word.\n"
                      "// Found anew along even directions, it went on.\n"),
              ElementsAre("1: rule 4: \"hang together\": say be connected",
                          "1: rule 4: \"left out\": say omit",
                          "1: rule 4: \"without a word\": say silently",
                          "2: rule 4: \"went on\": say continue, resume",
                          "2: rule 4: \"anew\": say again, re-",
                          "2: rule 4: \"even directions\": say evenly spread directions"));
}

TEST(English, TypesWithAWordInAnotherMeaningAreFound) {
  EXPECT_THAT(
      reports("enum class PartsBy { group };\nstruct GlossyFigures {};\nclass PassRounds;\n"),
      ElementsAre("1: rule 6: PartsBy", "2: rule 6: GlossyFigures", "3: rule 6: PassRounds"));
  EXPECT_THAT(reports("struct InsideParts {};\nclass SvgFigure {};\nclass ProcessGroup;\n"
                      "struct RefinementRound {};\nstruct KeptRun {};\nstruct Share {};\n"),
              IsEmpty());
}

TEST(English, LongParagraphsAndLinesAreFound) {
  const FileType document{.document = true};
  const std::string wide(70, 'x'), part = wide + " and " + wide;
  EXPECT_THAT(reports("# Title\n\nOne. Two. Three.\n\n- One. Two.\n- Three. Four. (See *this*.)\n",
                      document),
              IsEmpty());
  EXPECT_THAT(reports("**Label.** One. Two. Three.\n\n    code: " + part + "\n", document),
              IsEmpty());
  EXPECT_THAT(reports("One. **Two.** Three? Yes!\n", document),
              ElementsAre("1: rule 5: 4 sentences: One. **Two.** Three? Yes!"));
  EXPECT_THAT(reports(part + "\n", document), ElementsAre("1: rule 5: 145 characters"));
  EXPECT_THAT(reports("| " + part + " |\n\n# " + part + "\n\n```\n" + part + "\n```\n\n" + wide +
                          wide + "\n\n[a link](" + wide + ") and [another](" + wide + ")\n",
                      document),
              IsEmpty());
  EXPECT_THAT(reports("One. Two. Three. Four goes on.\n", {.document = true, .decision = true}),
              ElementsAre("1: rule 4: \"goes on\": say continue, resume"));
}

}  // namespace
}  // namespace transillum::english_test
