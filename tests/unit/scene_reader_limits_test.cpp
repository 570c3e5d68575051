// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// Time and memory of the OBJ and MTL readers are linear in their files, however these are written.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "base/text_file.h"
#include "scene_test_support.h"
#include "support/sanitizers.h"

namespace transillum::scene_reader_limits_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
const std::string white = "newmtl white\nKd .7 .7 .7\n";

std::string repeated(const std::string& text, std::size_t count) {
  std::string all;
  for (std::size_t k = 0; k < count; ++k) {
    all += text;
  }
  return all;
}

/// The largest memory that this process has used so far, bytes.
std::size_t peak_memory() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("VmHWM:")) {
      return std::stoul(line.substr(6)) * 1024;
    }
  }
  return 0;
}

/// Reads the file in a process of its own, which exits with 0 if that takes at most `most` bytes.
void expect_memory(const std::string& path, std::size_t most) {
  if (testing::has_address_sanitizer || testing::has_thread_sanitizer) {
    GTEST_SKIP() << "sanitizers keep freed memory for a while, and records of what is in use";
  }
  ::testing::FLAGS_gtest_death_test_style = "threadsafe";
  EXPECT_EXIT(
      {
        const std::size_t before = peak_memory();
        describe_scene(path);
        const std::size_t used = peak_memory() - before;
        std::fprintf(stderr, "%zu bytes\n", used);
        std::exit(used <= most ? 0 : 1);
      },
      ::testing::ExitedWithCode(0), "bytes");
}

// Each line used to be searched again from its beginning for every continuation, which took hours.
TEST(ReaderLimits, ContinuedLinesTakeLinearTime) {
  const test::TemporaryFolder folder;
  for (const char* const line : {"\\\n", " \\\r\n"}) {
    const std::string joined = repeated(line, 1'000'000);
    const SceneDescription d = describe_scene(
        folder.write("s.obj", fmt::format("{}f 1 2 \\\n{}3 4\n{}", square, joined, joined)));
    EXPECT_THAT(d.outline(0), ElementsAre(0, 1, 2, 3));
    EXPECT_THAT(d.face_line, ElementsAre(5));
  }
}

TEST(ReaderLimits, CommentsAreRecognizedInContinuedLines) {
  const std::string text = " \\\n\\\n # a comment \\\nv 1\\\n 2\n\\\n#last\\";
  const Cancellation never;
  LineReader lines(text, never);
  const auto line = lines.next();
  ASSERT_TRUE(line.has_value());
  EXPECT_EQ(line->keyword, "v");
  EXPECT_EQ(line->rest, "1  2");
  EXPECT_EQ(line->number, 4);
  EXPECT_FALSE(lines.next().has_value());
}

// Formerly checked every 4,096 logical lines.
TEST(ReaderLimits, EveryLineChecksTheCancellation) {
  const test::TemporaryFolder folder;
  folder.write("s.mtl", white);
  const Cancellation canceled;
  canceled.cancel();
  for (const std::string& text : {square, repeated("\\\n", 100), std::string(100, 'x')}) {
    EXPECT_THROW(describe_scene(folder.write("s.obj", text), {}, canceled), Canceled);
  }
  const Cancellation later;
  LineReader lines("a\nb\nc \\\n d\n", later);
  EXPECT_TRUE(lines.next().has_value());
  later.cancel();
  EXPECT_THROW(lines.next(), Canceled);
}

// A material of tinyobjloader has 1,300 bytes, and repeated ones were kept: 1.46 GB.
TEST(ReaderLimits, RepeatedMaterialsTakeNoMemory) {
  const test::TemporaryFolder folder;
  const std::string mtl = repeated("newmtl a\n", 500'000);
  folder.write("s.mtl", mtl);
  const auto path = folder.write("s.obj", "mtllib s.mtl\n" + square + "usemtl a\nf 1 2 3 4\n");
  expect_memory(path, 4 * mtl.size());
}

TEST(ReaderLimits, DifferentMaterialsTakeASmallMultipleOfTheirFile) {
  const test::TemporaryFolder folder;
  std::string mtl;
  for (int k = 0; k < 200'000; ++k) {
    mtl += "newmtl a" + std::to_string(k) + "\n";
  }
  folder.write("s.mtl", mtl);
  const auto path = folder.write("s.obj", "mtllib s.mtl\n" + square + "usemtl a7\nf 1 2 3 4\n");
  expect_memory(path, 40 * mtl.size());
  EXPECT_EQ(describe_scene(path).materials.size(), 200'000u);
}

// Each mentioned file was once read again, and its materials were reported as repeated.
TEST(ReaderLimits, AMaterialFileIsReadOnce) {
  const test::TemporaryFolder folder;
  folder.write("s.mtl", white);
  std::filesystem::create_symlink(folder.path() / "s.mtl", folder.path() / "link.mtl");
  const std::string use = square + "usemtl white\nf 1 2 3\n";
  for (const std::string& mentions :
       {repeated("mtllib s.mtl\n", 10'000), "mtllib" + repeated(" s.mtl", 10'000) + "\n",
        std::string("mtllib s.mtl\nmtllib ./s.mtl link.mtl\nmtllib .\\s.mtl\n")}) {
    const SceneDescription d = describe_scene(folder.write("s.obj", mentions + use));
    EXPECT_EQ(d.materials.size(), 1u);
    EXPECT_THAT(d.notes, IsEmpty());
    EXPECT_EQ(d.files.size(), 2u);
  }
  const SceneDescription d =
      describe_scene(folder.write("s.obj", repeated("mtllib gone.mtl s.mtl\n", 10'000) + use));
  EXPECT_EQ(d.materials.size(), 1u);
  EXPECT_THAT(d.notes, ::testing::ElementsAre(
                           ::testing::HasSubstr("s.obj:1: MTL file `gone.mtl` not found")));
}

// 50,000 took 46 s: each ray that meets one tests them all.
TEST(ReaderLimits, CopiesOfAFaceAreLimited) {
  const auto scene_of = [](int faces) {
    SceneDescription d = test::polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}});
    d.materials.clear();
    d.face_material.assign(1, 0);
    for (int k = 0; k < faces; ++k) {
      d.materials.push_back({"m" + std::to_string(k), {0.5, 0.5, 0.5}, {}});
      if (k > 0) {
        d.add_face(std::vector<PointId>{0, 1, 2}, k);
      }
    }
    return Scene(d);
  };
  EXPECT_EQ(scene_of(1001).patch_count(), 1001);
  EXPECT_EQ(test::refusal([&] { (void)scene_of(50'000); }),
            "test: face 1001: more than 1000 faces have the same points as face 0; delete the "
            "copies");
}

// Once, the whole name, of any length, was part of the message.
TEST(ReaderLimits, MessagesQuoteTheBeginningOfLongNames) {
  const test::TemporaryFolder folder;
  const std::string name(100'000, 'a');
  folder.write("s.mtl", "newmtl " + name + "\nKd 2 2 -2\n");
  const std::string message = test::refusal([&] {
    describe_scene(
        folder.write("s.obj", "mtllib s.mtl\n" + square + "usemtl " + name + "\nf 1 2 3\n"));
  });
  EXPECT_THAT(message, ::testing::HasSubstr("s.mtl:1: material `aaaa"));
  EXPECT_LT(message.size(), 300u);
}

// Once, the suggested name was written to the terminal unchanged.
TEST(ReaderLimits, MessagesContainNoControlCharacters) {
  const test::TemporaryFolder folder;
  folder.write("s.mtl", "newmtl whit\x1b\nKd .5 .5 .5\n");
  const SceneDescription d =
      describe_scene(folder.write("s.obj", "mtllib s.mtl\n" + square + "usemtl white\nf 1 2 3\n"));
  EXPECT_THAT(d.notes, ::testing::ElementsAre(::testing::EndsWith("assumed for 1 face")));
}

}  // namespace
}  // namespace transillum::scene_reader_limits_test
