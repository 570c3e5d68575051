// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// `transillum picture` and `map`: titles, transparency, the size of a printed pixel, and sizes that
// cannot be written.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>

#include <algorithm>
#include <fstream>

#include "support/pdf_content.h"
#include "support/program_call.h"
#include "support/sanitizers.h"

namespace transillum::testing::cli_figure_test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// The pixels of a PNG file with alpha, rows from the top.
struct Pixels {
  int width = 0, height = 0;
  std::vector<std::array<int, 4>> colors;

  const std::array<int, 4>& at(int column, int row) const {
    return colors.at(static_cast<std::size_t>(row * width + column));
  }
  std::ptrdiff_t count_alpha(int alpha) const {
    return std::count_if(colors.begin(), colors.end(),
                         [&](const auto& color) { return color[3] == alpha; });
  }
};

Pixels read_pixels(const std::string& path) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  EXPECT_NE(png_image_begin_read_from_file(&image, path.c_str()), 0) << image.message;
  image.format = PNG_FORMAT_RGBA;
  std::vector<unsigned char> bytes(PNG_IMAGE_SIZE(image));
  EXPECT_NE(png_image_finish_read(&image, nullptr, bytes.data(), 0, nullptr), 0) << image.message;
  EXPECT_EQ(image.warning_or_error, 0u) << image.message;
  Pixels pixels{static_cast<int>(image.width), static_cast<int>(image.height), {}};
  for (std::size_t k = 0; k + 3 < bytes.size(); k += 4) {
    pixels.colors.push_back({bytes[k], bytes[k + 1], bytes[k + 2], bytes[k + 3]});
  }
  return pixels;
}

/// 11,811 pixels per meter, which are 300 per inch, in both directions.
const std::string printed_size("pHYs\0\0\x2e\x23\0\0\x2e\x23\1", 13);

/// A lamp above a floor, seen from the side: nothing is seen beside them.
Arguments picture_of(const TemporaryFolder& folder) {
  folder.write("two.mtl", "newmtl floor\nKd .5 .4 .3\nnewmtl lamp\nKd 0 0 0\nKe 1 1 1\n");
  const std::string scene =
      folder.write("two.obj",
                   "mtllib two.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\n"
                   "v 1 1 1\nv 0 1 1\nusemtl floor\nf 1 2 3 4\nusemtl lamp\nf 8 7 6 5\n");
  return {"picture", scene, "--eye", "0.5,-2,0.7", "-m", "64", "-q", "--max-patch-area", "1"};
}

const Arguments map_call{"map", "furnace", "--direction", "1,2,3"};

TEST(CliFigure, PicturesHaveATitleIfAsked) {
  const TemporaryFolder folder;
  const Arguments call = picture_of(folder) + Arguments{"--size", "80x60"};
  expect_success(call + Arguments{"-o", folder / "plain.png"});
  expect_success(call + Arguments{"--title", "a < b", "-o", folder / "t.png", "-o",
                                  folder / "t.svg", "-o", folder / "t.pdf"});
  const Pixels plain = read_pixels(folder / "plain.png"), titled = read_pixels(folder / "t.png");
  EXPECT_EQ(titled.width, plain.width);
  ASSERT_GT(titled.height, plain.height + 10);
  // The picture is the same, below its title.
  EXPECT_TRUE(std::equal(plain.colors.rbegin(), plain.colors.rend(), titled.colors.rbegin()));
  EXPECT_THAT(read_file(folder / "t.svg"), HasSubstr(">a &lt; b</text>"));
  EXPECT_THAT(page_of(read_file(folder / "t.pdf")), HasSubstr("a < b)Tj"));
}

TEST(CliFigure, TransparentPicturesShowSurfacesOnly) {
  const TemporaryFolder folder;
  const Arguments call =
      picture_of(folder) + Arguments{"--size", "80x60", "--samples", "1", "--sky", "2"};
  expect_success(call + Arguments{"-o", folder / "opaque.png"});
  expect_success(call + Arguments{"--transparent", "-o", folder / "clear.png", "-o",
                                  folder / "clear.svg", "-o", folder / "clear.pdf"});
  const Pixels opaque = read_pixels(folder / "opaque.png"),
               clear = read_pixels(folder / "clear.png");
  EXPECT_EQ(opaque.count_alpha(255), 80 * 60);
  const std::ptrdiff_t seen = clear.count_alpha(255);
  EXPECT_GT(seen, 80 * 60 / 20);
  EXPECT_EQ(clear.count_alpha(0), 80 * 60 - seen);
  EXPECT_GT(clear.count_alpha(0), 80 * 60 / 20);
  for (std::size_t k = 0; k < clear.colors.size(); ++k) {
    if (clear.colors[k][3] == 255) {
      EXPECT_EQ(clear.colors[k], opaque.colors[k]) << k;
    }
  }
  EXPECT_THAT(read_file(folder / "clear.svg"), Not(HasSubstr("fill=\"#ffffff\"")));
  EXPECT_THAT(read_file(folder / "clear.pdf"), HasSubstr("/SMask"));
}

TEST(CliFigure, EdgesOfTransparentPicturesHaveTheColorOfTheSurface) {
  const TemporaryFolder folder;
  const Arguments call = picture_of(folder) + Arguments{"--size", "80x60", "--transparent"};
  expect_success(call + Arguments{"-o", folder / "p.png"});
  expect_success(call + Arguments{"--false-color", "--title", "F", "-o", folder / "f.png"});
  const Pixels plain = read_pixels(folder / "p.png"), titled = read_pixels(folder / "f.png");
  EXPECT_GT(titled.width, plain.width);
  EXPECT_GT(plain.count_alpha(64) + plain.count_alpha(128) + plain.count_alpha(191), 10);
  // The lamp is white, and its edge is not mixed with the black of nothing.
  for (int row = 0; row < 10; ++row) {
    for (int column = 0; column < plain.width; ++column) {
      const auto& color = plain.at(column, row);
      EXPECT_TRUE(color[3] == 0 || color[0] > 60) << column << ' ' << row;
    }
  }
  // Title and scale are drawn where nothing else is.
  EXPECT_EQ(titled.at(titled.width - 1, 0)[3], 0);
}

TEST(CliFigure, MapsHaveATitleIfAsked) {
  const TemporaryFolder folder;
  const Arguments call = map_call + Arguments{"--size", "600"};
  expect_success(call + Arguments{"-o", folder / "plain.png"});
  expect_success(call + Arguments{"--title", "a < b", "-o", folder / "t.png", "-o",
                                  folder / "t.svg", "-o", folder / "t.pdf"});
  const Pixels plain = read_pixels(folder / "plain.png"), titled = read_pixels(folder / "t.png");
  EXPECT_EQ(std::max(plain.width, plain.height), 600);
  EXPECT_EQ(titled.height, 600);  // with the title
  EXPECT_EQ(titled.at(0, 0), (std::array{255, 255, 255, 255}));
  EXPECT_EQ(titled.at(0, 599), plain.at(0, plain.height - 1));
  EXPECT_THAT(read_file(folder / "t.svg"), HasSubstr(">a &lt; b</text>"));
  EXPECT_THAT(page_of(read_file(folder / "t.pdf")), HasSubstr("a < b)Tj"));
  const std::string words(500, 'n');
  expect_success(call + Arguments{"--title", words, "-o", folder / "long.svg"});
  EXPECT_THAT(read_file(folder / "long.svg"), HasSubstr("n\u2026</text>"));
}

/// The end of a long name of a scene, in letters of two bytes.
TEST(CliFigure, NamesAreShortenedByTheirCharacters) {
  const TemporaryFolder folder;
  for (const char* name : {"room-with-lamp", "комната-лампой"}) {
    const auto scene = folder / (std::string(name) + ".obj");
    std::ofstream(scene) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    expect_success({"map", scene, "--direction", "0,0,1", "--size", "300", "-o", folder / "m.svg"});
    const std::string end = std::string(name).substr(name[0] == 'r' ? 4 : 8) + ".obj</text>";
    EXPECT_THAT(read_file(folder / "m.svg"), HasSubstr(end)) << name;
  }
}

TEST(CliFigure, TransparentMapsHaveNoBackground) {
  const TemporaryFolder folder;
  const Arguments call = map_call + Arguments{"--size", "600"};
  expect_success(call + Arguments{"-o", folder / "plain.png"});
  expect_success(call + Arguments{"--transparent", "-o", folder / "clear.png", "-o",
                                  folder / "clear.svg", "-o", folder / "clear.pdf"});
  const Pixels plain = read_pixels(folder / "plain.png"), clear = read_pixels(folder / "clear.png");
  const std::array<int, 4> ground = plain.at(0, 0);
  EXPECT_EQ(ground[3], 255);
  // The edge of a polygon covers a part of a pixel that may be too small to change its color.
  const auto grounds = std::count(plain.colors.begin(), plain.colors.end(), ground);
  EXPECT_LE(clear.count_alpha(0), grounds);
  EXPECT_GT(100 * clear.count_alpha(0), 99 * grounds);
  for (std::size_t k = 0; k < clear.colors.size(); ++k) {
    for (std::size_t channel = 0; clear.colors[k][3] == 255 && channel < 3; ++channel) {
      EXPECT_NEAR(clear.colors[k][channel], plain.colors[k][channel], 1) << k;
    }
  }
  const std::string svg = read_file(folder / "clear.svg");
  EXPECT_THAT(svg, Not(HasSubstr("class=\"page\"")));
  EXPECT_THAT(svg, Not(HasSubstr("class=\"ground\"")));
  EXPECT_THAT(page_of(read_file(folder / "clear.pdf")), Not(HasSubstr("1 1 1 rg")));
}

TEST(CliFigure, PngsOfMapsHaveTitlesInAnyLanguage) {
  const TemporaryFolder folder;
  const auto text_of = [&](const std::string& title) {
    expect_success(map_call + Arguments{"--size", "400", "--title", title, "-o", folder / "m.png"});
    read_pixels(folder / "m.png");
    return read_file(folder / "m.png");
  };
  using namespace std::string_literals;
  EXPECT_THAT(text_of("plain"), HasSubstr("tEXtTitle\0plain"s));
  EXPECT_THAT(text_of("Gr\u00f6\u00dfe"), HasSubstr("iTXtTitle\0\0\0\0\0Gr\u00f6\u00dfe"s));
  EXPECT_THAT(text_of("a\x01"
                      "b\nc"),
              HasSubstr("tEXtTitle\0a b c"s));
  EXPECT_THAT(text_of("a\xff"), HasSubstr("iTXtTitle\0\0\0\0\0a\ufffd"s));
  expect_refused(map_call + Arguments{"--title", "", "-o", folder / "m.png"},
                 "--title: the value is empty");
}

TEST(CliFigure, TitlesAreCutByCharacters) {
  const TemporaryFolder folder;
  std::string title;
  for (int k = 0; k < 20; ++k) {
    title += "\u00fc";
  }
  expect_success(map_call + Arguments{"--size", "600", "--title", title, "-o", folder / "m.svg"});
  EXPECT_THAT(read_file(folder / "m.svg"), HasSubstr('>' + title + "</text>"));
}

TEST(CliFigure, RadianceIsNeverTransparent) {
  const TemporaryFolder folder;
  const Arguments call = picture_of(folder) + Arguments{"--transparent", "-o", folder / "p.exr"};
  expect_refused(call, "--transparent: used only with a .png, .svg or .pdf file");
  expect_refused(call + Arguments{"-o", folder / "p.png"},
                 "--transparent: not used with .exr and .pfm files");
}

TEST(CliFigure, PrintedPngsSayHowLargeAPixelIs) {
  const TemporaryFolder folder;
  const Arguments call = picture_of(folder);
  expect_success(call + Arguments{"--size", "1.27x1.27cm", "-o", folder / "p.png"});
  expect_success(call + Arguments{"--size", "1.27x1.27cm", "--title", "T", "-o", folder / "t.png"});
  expect_success(map_call + Arguments{"--size", "2.54cm", "-o", folder / "m.png"});
  for (const char* name : {"p.png", "t.png", "m.png"}) {
    const std::string png = read_file(folder / name);
    EXPECT_THAT(png, HasSubstr(printed_size)) << name;
    EXPECT_LT(png.find(printed_size), png.find("IDAT")) << name;
  }
  EXPECT_EQ(read_pixels(folder / "p.png").width, 150);
  // Letters of a printed title are as high as on a screen, in inches.
  EXPECT_GT(read_pixels(folder / "t.png").height, 150 + 70);
  const Pixels map = read_pixels(folder / "m.png");
  EXPECT_EQ(std::max(map.width, map.height), 300);
  expect_success(call + Arguments{"--size", "80x60", "-o", folder / "s.png"});
  EXPECT_THAT(read_file(folder / "s.png"), Not(HasSubstr("pHYs")));
}

TEST(CliFigure, SizesThatCannotBeWrittenAreRefusedBeforeASolve) {
  const TemporaryFolder folder;
  // A solve of these would take hours.
  const Arguments call{"picture", "cornell-box", "--eye", "0.2,0.2,0.2",
                       "-m",      "16000000",    "-o",    folder / "p.png"};
  expect_refused(call + Arguments{"--size", "32768x10"}, "--size: \"32768\"");
  expect_refused(call + Arguments{"--size", "1x32767", "--title", "T"},
                 "--size: \"1x32767\" is too large for");
  expect_refused(call + Arguments{"--size", "32767x1", "--false-color"},
                 "--size: \"32767x1\" is too large for");
  expect_refused(call + Arguments{"--size", "9x900cm"},
                 "--size: \"9x900cm\" must have sides of 0.0085 to 277.4 cm");
  const Arguments map = map_call + Arguments{"-o", folder / "m.png"};
  expect_refused(map + Arguments{"--size", "900cm"}, "--size: 900cm is too large for");
  expect_refused(map + Arguments{"--size", "1cm"}, "--size: 1cm is too small for");
  expect_refused(map_call + Arguments{"-o", folder / "m.svg", "--size", "300cm"},
                 "the most is 216cm");
  // Limits that are named are kept.
  expect_refused(map + Arguments{"--size", "69.4cm"}, "the most is 69.3cm");
  expect_refused(map + Arguments{"--size", "1.68cm"}, "the least is 1.7cm");
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(CliFigure, PicturesThatDoNotFitInMemoryAreRefusedBeforeASolve) {
  if (has_address_sanitizer || has_thread_sanitizer) {
    GTEST_SKIP() << "sanitizers reserve terabytes of addresses";
  }
  const TemporaryFolder folder;
  for (const Arguments& call :
       {Arguments{"picture", "cornell-box", "--eye", "0.2,0.2,0.2", "-m", "16000000", "--size",
                  "9000x9000", "-o", folder / "p.png"},
        map_call + Arguments{"--size", "8000", "-o", folder / "m.png"}}) {
    const ProgramResult result = RunningProgram(call, {}, {}, {}, "ulimit -v 1000000").wait();
    EXPECT_EQ(result.status, 2);
    EXPECT_THAT(result.err, HasSubstr("GB of memory"));
    EXPECT_THAT(result.err, HasSubstr("GB are free"));
  }
  EXPECT_THAT(folder.names(), IsEmpty());
}

}  // namespace
}  // namespace transillum::testing::cli_figure_test
