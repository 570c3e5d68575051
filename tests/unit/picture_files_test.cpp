// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Files of pictures are read back: PNG by libpng, OpenEXR by its library, PFM byte by byte; figures
// as text. Tone
// curves and scales of false colors have known values.
#include "transillum/files.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <png.h>

#include <array>
#include <cmath>
#include <cstring>
#include <numbers>
#include <vector>

#include "base/base64.h"
#include "geometry/luminance.h"
#include "io/drawing/color_bar.h"
#include "io/drawing/picture_figure.h"
#include "io/pictures/color_map.h"
#include "io/srgb.h"
#include "support/pdf_content.h"
#include "support/temporary_folder.h"
#include "transillum/errors.h"
#include "transillum/picture.h"

namespace transillum::picture_files_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::ThrowsMessage;

/// The radiance of a surface of this radiosity, W/m².
Rgb radiance_of(double r, double g, double b) { return 1 / std::numbers::pi * Rgb{r, g, b}; }

/// 3 by 2 pixels; all numbers differ, some are above white, one is below 0.
Picture small_picture() {
  return {3,
          2,
          {radiance_of(0, 0.25, 1), radiance_of(0.5, 0.5, 0.5), radiance_of(4, 2, 1),
           radiance_of(-0.1, 0.1, 0.2), radiance_of(0.003, 0.002, 0.001), radiance_of(1, 1, 1)}};
}

using Bytes = std::array<int, 3>;

/// The pixels of a PNG file, rows from the top.
struct Png {
  int width = 0, height = 0;
  std::vector<Bytes> pixels;

  const Bytes& at(int column, int row) const {
    return pixels[static_cast<std::size_t>(row * width + column)];
  }
};

Png read_png(const std::string& path) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  EXPECT_NE(png_image_begin_read_from_file(&image, path.c_str()), 0) << image.message;
  image.format = PNG_FORMAT_RGB;
  std::vector<unsigned char> bytes(PNG_IMAGE_SIZE(image));
  EXPECT_NE(png_image_finish_read(&image, nullptr, bytes.data(), 0, nullptr), 0) << image.message;
  Png png{static_cast<int>(image.width), static_cast<int>(image.height), {}};
  for (std::size_t k = 0; k + 2 < bytes.size(); k += 3) {
    png.pixels.push_back({bytes[k], bytes[k + 1], bytes[k + 2]});
  }
  return png;
}

Bytes srgb(double r, double g, double b) { return {srgb_byte(r), srgb_byte(g), srgb_byte(b)}; }

TEST(PictureFiles, PngHasKnownBytes) {
  const test::TemporaryFolder folder;
  write_picture(folder / "p.png", small_picture());
  const Png png = read_png(folder / "p.png");
  EXPECT_EQ(png.width, 3);
  EXPECT_EQ(png.height, 2);
  // sRGB of 0.25 and 0.5 is 137 and 188; what is too bright keeps its hue.
  EXPECT_EQ(png.at(0, 0), (Bytes{0, 137, 255}));
  EXPECT_EQ(png.at(1, 0), (Bytes{188, 188, 188}));
  EXPECT_EQ(png.at(2, 0), (Bytes{255, 188, 137}));
  EXPECT_EQ(png.at(0, 1), srgb(0, 0.1, 0.2));
  EXPECT_EQ(png.at(2, 1), (Bytes{255, 255, 255}));
  write_picture(folder / "q.png", small_picture(), {.exposure = 0.5});
  EXPECT_EQ(read_png(folder / "q.png").at(2, 1), (Bytes{188, 188, 188}));
}

TEST(PictureFiles, ExrHasTheRadianceAsFloats) {
  const test::TemporaryFolder folder;
  const Picture picture = small_picture();
  write_picture(folder / "p.exr", picture, {.exposure = 7});  // which changes nothing
  Imf::InputFile file((folder / "p.exr").c_str());
  ASSERT_EQ(file.header().dataWindow().max.x, 2);
  ASSERT_EQ(file.header().dataWindow().max.y, 1);
  std::vector<float> numbers(3 * picture.radiance.size());
  Imf::FrameBuffer buffer;
  constexpr std::array names{"R", "G", "B"};
  for (std::size_t c = 0; c < 3; ++c) {
    ASSERT_NE(file.header().channels().findChannel(names[c]), nullptr);
    EXPECT_EQ(file.header().channels().findChannel(names[c])->type, Imf::FLOAT);
    buffer.insert(names[c], Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(&numbers[c]),
                                       3 * sizeof(float), 9 * sizeof(float)));
  }
  file.setFrameBuffer(buffer);
  file.readPixels(0, 1);
  for (std::size_t k = 0; k < picture.radiance.size(); ++k) {
    const Rgb& radiance = picture.radiance[k];
    EXPECT_EQ(numbers[3 * k], static_cast<float>(radiance.r)) << k;
    EXPECT_EQ(numbers[3 * k + 1], static_cast<float>(radiance.g)) << k;
    EXPECT_EQ(numbers[3 * k + 2], static_cast<float>(radiance.b)) << k;
  }
}

TEST(PictureFiles, PfmHasRowsFromTheBottom) {
  const test::TemporaryFolder folder;
  const Picture picture = small_picture();
  write_picture(folder / "p.pfm", picture);
  const std::string file = test::read_file(folder / "p.pfm"), header = "PF\n3 2\n-1.0\n";
  ASSERT_EQ(file.size(), header.size() + 18 * sizeof(float));
  EXPECT_EQ(file.substr(0, header.size()), header);
  std::array<float, 18> numbers{};
  std::memcpy(numbers.data(), file.data() + header.size(), sizeof(numbers));
  for (std::size_t row = 0; row < 2; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      const Rgb& radiance = picture.radiance[3 * (1 - row) + column];
      const float* pixel = &numbers[9 * row + 3 * column];
      EXPECT_EQ(pixel[0], static_cast<float>(radiance.r));
      EXPECT_EQ(pixel[1], static_cast<float>(radiance.g));
      EXPECT_EQ(pixel[2], static_cast<float>(radiance.b));
    }
  }
}

TEST(PictureFiles, BadCallsAreRefusedAndLeaveNoFile) {
  const test::TemporaryFolder folder;
  const Picture picture = small_picture();
  const auto refused = [](const auto& write, const std::string& text) {
    EXPECT_THAT(write, ThrowsMessage<InputError>(HasSubstr(text)));
  };
  refused([&] { write_picture(folder / "p.jpg", picture); }, "must end in .png, .exr or .pfm");
  refused([&] { check_picture_path(folder / "p"); }, "must end in .png, .exr or .pfm");
  refused([&] { check_picture_path("/no/such/folder/p.png"); }, "/no/such/folder");
  refused([&] { write_picture(folder / "p.png", picture, {.exposure = 0}); }, "exposure: 0 is not");
  refused([&] { write_picture(folder / "p.exr", {2, 2, {{}}}); }, "1 colors for 2 by 2 pixels");
  refused([&] { write_picture(folder / "p.exr", {}); }, "0 colors for 0 by 0 pixels");
  refused([&] { write_false_colors(folder / "p.exr", picture, {}); }, "must end in .png");
  refused([&] { write_false_colors(folder / "p.png", picture, {.highest = -1}); },
          "upper end of the scale: -1 is not");
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(ToneCurves, HaveKnownValues) {
  const auto gray = [](double light, ToneCurve tone) {
    return shown_color(radiance_of(light, light, light), {.tone = tone}).g;
  };
  EXPECT_NEAR(gray(0.3, ToneCurve::linear), 0.3, 1e-12);
  // Narkowicz: x (2.51 x + 0.03) / (x (2.43 x + 0.59) + 0.14).
  EXPECT_NEAR(gray(1, ToneCurve::aces), 2.54 / 3.16, 1e-12);
  EXPECT_NEAR(gray(0.18, ToneCurve::aces), 0.086724 / 0.324932, 1e-12);
  // Hable: white, 11.2, is reached at half of it.
  EXPECT_NEAR(gray(5.6, ToneCurve::filmic), 1, 1e-12);
  EXPECT_NEAR(gray(1, ToneCurve::filmic), (0.704 / 1.66 - 1 / 15.0) / (19.38 / 24.476 - 1 / 15.0),
              1e-12);
}

TEST(ToneCurves, AreMonotonicFromBlackToWhite) {
  for (const std::string& name : names_of<ToneCurve>()) {
    const PictureLook look{.tone = from_name<ToneCurve>(name)};
    EXPECT_NEAR(max_abs(shown_color({}, look)), 0, 1e-12) << name;
    double before = 0;
    for (int k = 0; k < 115; ++k) {
      const double light = 1e-4 * std::pow(1.3, k);
      const Rgb color = shown_color(radiance_of(light, light, light), look);
      EXPECT_GE(color.g, before * (1 - 1e-15)) << name << ' ' << light;
      EXPECT_LE(color.g, 1) << name << ' ' << light;
      before = color.g;
    }
    EXPECT_NEAR(before, 1, 1e-15) << name;
  }
}

TEST(FalseColors, TicksCoverTheRange) {
  for (const double highest : {1.0, 0.013, 4.37, 683.0, 2e5, 9.99}) {
    const std::vector<double> ticks = color_bar_ticks(highest);
    ASSERT_GE(ticks.size(), 4U) << highest;
    EXPECT_LE(ticks.size(), 11U) << highest;
    EXPECT_EQ(ticks.front(), 0);
    EXPECT_LE(ticks.back(), highest * (1 + 1e-9));
    EXPECT_GT(ticks.back() + ticks[1], highest) << highest;
  }
  EXPECT_THAT(color_bar_ticks(1),
              ElementsAre(0, 0.2, ::testing::DoubleEq(0.4), ::testing::DoubleEq(0.6), 0.8, 1));
}

TEST(FalseColors, ShowLuminanceBesideItsScale) {
  const test::TemporaryFolder folder;
  Picture picture{64, 100, {}};
  for (int row = 0; row < picture.height; ++row) {
    for (int column = 0; column < picture.width; ++column) {
      picture.radiance.push_back(radiance_of(4.0 * column / picture.width, 1, 0.5));
    }
  }
  write_false_colors(folder / "w.png", picture, {.highest = 2});
  write_false_colors(folder / "lx.png", picture, {.highest = 2, .lux = true});
  const Png watts = read_png(folder / "w.png"), lux = read_png(folder / "lx.png");
  EXPECT_GT(watts.width, picture.width + 30);
  EXPECT_GE(watts.height, picture.height);  // room for the title
  for (int column = 0; column < picture.width; ++column) {
    const Rgb b{4.0 * column / picture.width, 1, 0.5};
    const ColorBytes color = color_of(default_color_map, luminance(b) / 2);
    EXPECT_EQ(watts.at(column, 50), (Bytes{color[0], color[1], color[2]})) << column;
    EXPECT_EQ(lux.at(column, 50), watts.at(column, 50));
  }
  // The labels differ: 1366 lx instead of 2 W/m².
  EXPECT_NE(lux.width, watts.width);
  // The scale has the color map, its upper end above.
  const Bytes paper{255, 255, 255};
  std::vector<Bytes> scale;
  for (int row = 0; row < watts.height; ++row) {
    if (const Bytes& color = watts.at(picture.width + 18, row); color != paper) {
      scale.push_back(color);
    }
  }
  ASSERT_GT(scale.size(), 60U);
  for (std::size_t k = 0; k < scale.size(); ++k) {
    const double from_top = (static_cast<double>(k) + 0.5) / static_cast<double>(scale.size());
    const ColorBytes color = color_of(default_color_map, 1 - from_top);
    EXPECT_EQ(scale[k], (Bytes{color[0], color[1], color[2]})) << k;
  }
}

/// A picture whose title has letters that XML escapes.
const PictureFigure watts{.title = "a < b", .false_colors = FalseColors{.highest = 2}};

TEST(PictureFigures, SvgHasThePictureAsPngAndItsScaleAsVectorsAndText) {
  const test::TemporaryFolder folder;
  write_figure(folder / "p.svg", small_picture(), {.look = {.exposure = 0.5}});
  write_picture(folder / "p.png", small_picture(), {.exposure = 0.5});
  const std::string plain = test::read_file(folder / "p.svg");
  EXPECT_THAT(plain, HasSubstr("base64," + to_base64(test::read_file(folder / "p.png")) + "\""));
  EXPECT_THAT(plain, HasSubstr("viewBox=\"0 0 3 2\""));
  EXPECT_THAT(plain, Not(HasSubstr("<text")));
  write_figure(folder / "w.svg", small_picture(), watts);
  const std::string svg = test::read_file(folder / "w.svg");
  std::vector<std::string> texts{"a &lt; b", "radiosity B, W/m\u00b2"};
  for (const double tick : color_bar_ticks(2)) {
    texts.push_back(fmt::format("{:.6g}", tick));
  }
  for (const std::string& text : texts) {
    EXPECT_THAT(svg, HasSubstr(">" + text + "</text>"));
  }
  EXPECT_THAT(svg, HasSubstr("<title>a &lt; b</title>"));
  EXPECT_THAT(svg, HasSubstr("fill=\"#f9e725\""));  // the first row of the scale
}

TEST(PictureFigures, PdfHasThePictureAsImageAndItsScaleAsVectorsAndText) {
  const test::TemporaryFolder folder;
  PictureFigure figure = watts;
  figure.pixels_per_inch = 12;  // 3 by 2 pixels of 6 points
  write_figure(folder / "w.pdf", small_picture(), figure);
  const std::string pdf = test::read_file(folder / "w.pdf");
  EXPECT_THAT(pdf, HasSubstr("/ToUnicode"));
  EXPECT_THAT(pdf, HasSubstr("/Subtype /Image"));
  EXPECT_THAT(pdf, HasSubstr("/Width 3"));
  const std::string page = testing::page_of(pdf);
  EXPECT_THAT(page, HasSubstr("18 0 0 -12 0 "));  // the picture's size
  EXPECT_THAT(page, HasSubstr("a < b)Tj"));
  EXPECT_THAT(page, HasSubstr("radiosity B, W/m"));
  EXPECT_THAT(page, HasSubstr("0.976471 0.905882 0.145098 rg"));  // the same color
}

TEST(PictureFigures, RefuseOtherEndingsAndValues) {
  const test::TemporaryFolder folder;
  const auto refused = [](const auto& write, const std::string& message) {
    EXPECT_THAT(write, ThrowsMessage<InputError>(HasSubstr(message)));
  };
  refused([&] { write_figure(folder / "p.exr", small_picture(), {}); },
          "must end in .png, .svg or .pdf");
  refused([&] { check_figure_path(folder / "p.gif"); }, "must end in .png, .svg, .pdf, .exr or");
  refused([&] { check_figure_path("/no/such/folder/p.pdf"); }, "/no/such/folder");
  refused([&] { write_figure(folder / "p.pdf", {}, {}); }, "0 colors for 0 by 0 pixels");
  refused(
      [&] {
        write_figure(folder / "p.svg", small_picture(),
                     {.false_colors = FalseColors{.highest = -1}});
      },
      "upper end of the scale: -1 is not");
  EXPECT_THAT(folder.names(), IsEmpty());
}

}  // namespace
}  // namespace transillum::picture_files_test
