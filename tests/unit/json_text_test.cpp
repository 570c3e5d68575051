// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// check_json(): accepted texts, the message for each refused text, and that time and memory do not
// depend on how deep a text is.
#include "base/json_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/refusal.h"
#include "support/temporary_folder.h"

namespace transillum::testing::json_text_test {
namespace {

using test::refusal;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

// Not by the constructor of std::string: with constant arguments, compilers try to evaluate it.
std::string repeated(const std::string& text, std::size_t count) {
  std::string all;
  all.reserve(count * text.size());
  for (std::size_t k = 0; k < count; ++k) {
    all += text;
  }
  return all;
}

std::string message(const std::string& text) {
  return refusal([&] { check_json(text, "a.json"); });
}

TEST(JsonText, AcceptsWhatParsersRead) {
  for (const char* text : {
           "{}",
           " [1, -2.5e-3, \"\\u00e4\\n\", true, false, null] \r\n",
           "\xef\xbb\xbf{\"a\": {\"a\": 1}, \"b\": 1.7976931348623157e308}",
           "18446744073709551616",
           "1e-999",
           "[{\"a\": 1}, {\"a\": 1}]",
       }) {
    EXPECT_THAT(message(text), IsEmpty()) << text;
    EXPECT_TRUE(nlohmann::json::accept(text)) << text;
  }
}

TEST(JsonText, RefusesWithLineColumnAndReason) {
  const std::pair<std::string, const char*> cases[] = {
      {"", "a.json: an empty file"},
      {" \n\t\r\n", "a.json: an empty file"},
      {"\xef\xbb\xbf", "a.json, line 1, column "},
      {"{", "a.json, line 1, column "},
      {"{\"a\": 1\n\"b\": 2}", "a.json, line 2, column 3: invalid JSON"},
      {"{\"ä\": 1,\n \"ö\": x}", "a.json, line 2, column 7: invalid JSON"},
      {"{\"a\": 1e999}", "a.json, line 1, column 12: the number `1e999` is out of range"},
      {"[1,\n-1.5e400]", "a.json, line 2, column 9: the number `-1.5e400` is out of range"},
      {"{\"a\": 1, \"b\": {\"a\": 1},\n \"a\": 2}",
       "a.json, line 2, column 4: the key `a` occurs twice in one object"},
      {std::string("{\"a\": \0}", 8), "a.json, line 1, column 7: invalid JSON"},
      {"{\"a\": \"\xff\"}", "a.json, line 1, column 8: invalid JSON"},
      {"\"a", "invalid JSON"},
      {"[1] [2]", "a.json, line 1, column 5: invalid JSON"},
      {"[NaN]", "invalid JSON"},
      {"[0x10]", "invalid JSON"},
      {"[1,]", "invalid JSON"},
      {"{'a': 1}", "invalid JSON"},
      {"// comment\n{}", "invalid JSON"},
      {"\"\\ud800\"", "invalid JSON"},
  };
  for (const auto& [text, expected] : cases) {
    EXPECT_THAT(message(text), HasSubstr(expected)) << text;
    EXPECT_THAT(message(text), ::testing::Not(HasSubstr("\n"))) << text;
  }
}

TEST(JsonText, DepthIsLimited) {
  EXPECT_THAT(message(repeated("[", deepest_json) + repeated("]", deepest_json)), IsEmpty());
  const std::size_t levels[] = {deepest_json + 1, 2'000'000};
  for (const std::size_t level : levels) {
    EXPECT_THAT(message(repeated("[", level) + repeated("]", level)),
                StartsWith("a.json, line 1, column 65: more than 64 lists and objects"));
    EXPECT_THAT(message(repeated("{\"a\":", level)), HasSubstr("more than 64 lists and objects"));
    EXPECT_THAT(message(repeated("[", level)), HasSubstr("more than 64 lists and objects"));
  }
}

TEST(JsonText, SizeIsLimited) {
  EXPECT_THAT(message("[" + repeated("0,", most_json_values - 2) + "0]"), IsEmpty());
  EXPECT_THAT(message("[" + repeated("0,", most_json_values - 1) + "0]"),
              HasSubstr("more than 1000000 values"));
  EXPECT_THAT(message("[" + repeated("0,", 7'000'000) + "0]"),
              HasSubstr("more than 1000000 values"));
  EXPECT_THAT(message("\"" + repeated("a", largest_json_file) + "\""),
              HasSubstr("16777218 bytes of JSON; the limit is 16777216"));
}

TEST(JsonText, FilesAreReadWithinLimits) {
  const test::TemporaryFolder folder;
  EXPECT_EQ(read_json_file(folder.write("good.json", "{}\n")), "{}\n");
  const auto refused = [&](const std::filesystem::path& path) {
    return refusal([&] { (void)read_json_file(path); });
  };
  EXPECT_THAT(refused(folder.path() / "none.json"), HasSubstr("none.json: no such file"));
  EXPECT_THAT(refused(folder.path()), HasSubstr("not a regular file"));
  EXPECT_THAT(refused("/dev/zero"), HasSubstr("/dev/zero: not a regular file"));
  EXPECT_THAT(refused(folder.write("large.json", repeated(" ", largest_json_file + 1))),
              HasSubstr("the limit is 16777216"));
  EXPECT_THAT(refused(folder.write("utf16.json", std::string("\xff\xfe{\0}\0", 6))),
              HasSubstr("utf16.json: text in UTF-16; save it as UTF-8"));
  EXPECT_THAT(refused(folder.write("utf16be.json", std::string("\xfe\xff\0{\0}", 6))),
              HasSubstr("text in UTF-16"));
  EXPECT_THAT(refused(folder.write("zero.json", std::string("{\0}", 3))), HasSubstr("binary"));
}

}  // namespace
}  // namespace transillum::testing::json_text_test
