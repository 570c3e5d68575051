// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Pictures with what explains them: title above, scale of false colors at the right. One function
// lays them out; the formats differ in what draws the picture, and in the device of the canvas.
#include "io/drawing/picture_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <ostream>
#include <sstream>
#include <utility>
#include <vector>

#include "base/text_file.h"
#include "io/drawing/cairo_surface.h"
#include "io/drawing/chart_canvas.h"
#include "io/drawing/color_bar.h"
#include "io/drawing/svg_device.h"
#include "io/pictures/color_map.h"
#include "io/pictures/picture_writers.h"
#include "io/png_text.h"
#include "transillum/errors.h"

namespace transillum {
namespace {

/// Layout of a figure, in pixels of a screen with scale 1.
class PictureSheet {
 public:
  using DrawImage = std::function<void(const ChartArea& area)>;

  /// @param measuring  measures texts
  PictureSheet(const Picture& picture, const PictureFigure& figure, cairo_t* measuring)
      : title_{clean_text(figure.title)}, has_paper_(picture.coverage.empty()) {
    const double pixel = PictureFigure::screen / figure.pixels_per_inch;
    const double picture_height = pixel * picture.height;
    text_size_ = scale_text_size(picture_height);
    // The picture begins at a whole pixel of its own.
    image_.top = title_.empty() ? 0 : pixel * std::ceil(2.4 * text_size_ / pixel);
    image_.right = pixel * picture.width;
    image_.bottom = image_.top + picture_height;
    ChartCanvas canvas(measuring, scale_font);
    double bar_height = 0;
    if (figure.false_colors) {
      bar_.emplace(*figure.false_colors, text_size_);
      bar_width_ = bar_->width(canvas);
      bar_height = bar_->least_height(canvas);
    }
    width_ = image_.right + bar_width_;
    height_ = image_.top + std::max(picture_height, bar_height);
    title_ = canvas.elided(title_, width_, title_look());
  }

  double width() const { return width_; }
  double height() const { return height_; }
  const std::optional<ColorBar>& bar() const { return bar_; }

  void draw(ChartCanvas& canvas, const DrawImage& draw_image) const {
    if (has_paper_) {
      canvas.fill({0, 0, width_, height_}, scale_paper);
    }
    if (!title_.empty()) {
      canvas.draw(title_, {0, image_.top / 2}, 0, title_look());
    }
    draw_image(image_);
    if (bar_) {
      bar_->draw(canvas, {image_.right, image_.top, width_, height_});
    }
  }

 private:
  ChartText title_look() const { return {1.3 * text_size_, scale_ink, true}; }

  std::string title_;
  bool has_paper_;
  double text_size_ = 0, bar_width_ = 0, width_ = 0, height_ = 0;
  ChartArea image_;
  std::optional<ColorBar> bar_;
};

/// sRGB, as pixel_colors()
std::vector<unsigned char> colors_of(const Picture& picture, const PictureFigure& figure,
                                     const std::optional<ColorBar>& bar) {
  if (!bar) {
    return screen_colors(picture, figure.look);
  }
  return pixel_colors(picture, [&](const Rgb& radiance, std::vector<unsigned char>& bytes) {
    const ColorBytes color = color_of(default_color_map, bar->fraction_of(radiance));
    bytes.insert(bytes.end(), color.begin(), color.end());
  });
}

CairoSurface surface_of(const Picture& picture, const std::vector<unsigned char>& colors) {
  const bool transparent = !picture.coverage.empty();
  CairoSurface surface = make_surface(picture.width, picture.height, transparent);
  check_drawn(cairo_surface_status(surface.get()));
  unsigned char* bytes = cairo_image_surface_get_data(surface.get());
  const std::ptrdiff_t stride = cairo_image_surface_get_stride(surface.get());
  const unsigned char* next = colors.data();
  for (int y = 0; y < picture.height; ++y) {
    auto* row = reinterpret_cast<std::uint32_t*>(bytes + y * stride);
    for (int x = 0; x < picture.width; ++x, next += transparent ? 4 : 3) {
      const std::uint32_t alpha = transparent ? next[3] : 255;
      row[x] = alpha << 24;
      for (int channel = 0; channel < 3; ++channel) {
        row[x] |= (next[channel] * alpha + 127) / 255 << (16 - 8 * channel);
      }
    }
  }
  cairo_surface_mark_dirty(surface.get());
  return surface;
}

/// Draws a figure by Cairo.
void draw_by_cairo(cairo_t* cairo, const PictureSheet& sheet, cairo_surface_t* picture) {
  ChartCanvas canvas(cairo, scale_font);
  sheet.draw(canvas, [&](const ChartArea& area) {
    cairo_save(cairo);
    cairo_translate(cairo, area.left, area.top);
    cairo_scale(cairo, (area.right - area.left) / cairo_image_surface_get_width(picture),
                (area.bottom - area.top) / cairo_image_surface_get_height(picture));
    cairo_set_source_surface(cairo, picture, 0, 0);
    cairo_pattern_set_filter(cairo_get_source(cairo), CAIRO_FILTER_NEAREST);
    cairo_paint(cairo);
    cairo_restore(cairo);
  });
}

/// A context that measures texts of pixels.
CairoContext measuring_pixels() {
  const CairoSurface any = make_surface(1, 1);  // which the context keeps
  return {cairo_create(any.get()), cairo_destroy};
}

/// Width and height.
std::pair<int, int> pixels_of(const PictureSheet& sheet, const PictureFigure& figure) {
  const double pixels = figure.pixels_per_inch / PictureFigure::screen;
  return {static_cast<int>(std::lround(pixels * sheet.width())),
          static_cast<int>(std::lround(pixels * sheet.height()))};
}

void write_figure_png(std::ostream& out, const Picture& picture, const PictureFigure& figure) {
  const bool on_screen = figure.pixels_per_inch == PictureFigure::screen;
  const std::string size = png_size_chunk(on_screen ? 0 : figure.pixels_per_inch);
  if (figure.title.empty() && !figure.false_colors) {
    out << png_with_chunks(
        png_of(picture.width, picture.height, screen_colors(picture, figure.look)), size);
    return;
  }
  const PictureSheet sheet(picture, figure, measuring_pixels().get());
  const auto [width, height] = pixels_of(sheet, figure);
  const CairoSurface page = make_surface(width, height, !picture.coverage.empty());
  check_drawn(cairo_surface_status(page.get()));
  const CairoSurface image = surface_of(picture, colors_of(picture, figure, sheet.bar()));
  const CairoContext cairo(cairo_create(page.get()), cairo_destroy);
  const double pixels = figure.pixels_per_inch / PictureFigure::screen;
  cairo_scale(cairo.get(), pixels, pixels);
  draw_by_cairo(cairo.get(), sheet, image.get());
  check_drawn(cairo_status(cairo.get()));
  std::ostringstream png;
  write_png(png, page.get());
  out << png_with_chunks(png.str(), size);
}

void write_figure_pdf(std::ostream& out, const Picture& picture, const PictureFigure& figure) {
  const PictureSheet sheet(picture, figure, make_measuring_context().get());
  const CairoSurface image = surface_of(picture, colors_of(picture, figure, sheet.bar()));
  write_pdf(out, sheet.width(), sheet.height(), figure.title,
            [&](cairo_t* cairo) { draw_by_cairo(cairo, sheet, image.get()); });
}

void write_figure_svg(std::ostream& out, const Picture& picture, const PictureFigure& figure) {
  const CairoContext cairo = make_measuring_context();
  const PictureSheet sheet(picture, figure, cairo.get());
  const std::string png =
      png_of(picture.width, picture.height, colors_of(picture, figure, sheet.bar()));
  const std::string scale = sheet.bar() ? "scale: " + sheet.bar()->title() : std::string();
  SvgDevice svg(out, sheet.width(), sheet.height(), scale_font, figure.title, scale);
  ChartCanvas canvas(cairo.get(), scale_font, &svg);
  sheet.draw(canvas, [&](const ChartArea& area) { svg.image(area, png); });
  check_drawn(cairo_status(cairo.get()));
}

using FigureWriter = void (*)(std::ostream&, const Picture&, const PictureFigure&);

void write_with(FigureWriter write, const std::filesystem::path& path, const Picture& picture,
                const PictureFigure& figure) {
  check_writable(path);
  check_pixels(picture);
  figure.look.validate();
  if (figure.false_colors) {
    figure.false_colors->validate();
  }
  write_file_whole(path, [&](std::ostream& out) { write(out, picture, figure); });
}

}  // namespace

std::pair<int, int> figure_pixels(int width, int height, const PictureFigure& figure) {
  Picture picture;
  picture.width = width;
  picture.height = height;
  return pixels_of(PictureSheet(picture, figure, measuring_pixels().get()), figure);
}

bool is_figure_file(const std::filesystem::path& path) {
  const std::string ending = lower_case_ending(path);
  return ending == ".svg" || ending == ".pdf";
}

void check_figure_path(const std::filesystem::path& path) {
  if (!is_figure_file(path) && !is_picture_file(path)) {
    throw InputError(fmt::format(
        "{}: the name of a picture must end in .png, .svg, .pdf, .exr or .pfm", path.string()));
  }
  check_writable(path);
}

void write_figure(const std::filesystem::path& path, const Picture& picture,
                  const PictureFigure& figure) {
  if (!is_figure_file(path) && !is_screen_picture(path)) {
    throw InputError(
        fmt::format("{}: the name of a figure must end in .png, .svg or .pdf", path.string()));
  }
  write_with(is_screen_picture(path)             ? write_figure_png
             : lower_case_ending(path) == ".svg" ? write_figure_svg
                                                 : write_figure_pdf,
             path, picture, figure);
}

void write_false_colors(const std::filesystem::path& path, const Picture& picture,
                        const FalseColors& colors) {
  if (!is_screen_picture(path)) {
    throw InputError(
        fmt::format("{}: the name of a picture in false colors must end in .png", path.string()));
  }
  write_with(write_figure_png, path, picture, {.false_colors = colors});
}

}  // namespace transillum
