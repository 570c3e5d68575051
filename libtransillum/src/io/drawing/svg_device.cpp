// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "io/drawing/svg_device.h"

#include "base/base64.h"

namespace transillum {
namespace {

std::string hex(const ChartColor& color) {
  return fmt::format("#{:02x}{:02x}{:02x}", color.red, color.green, color.blue);
}

/// Which point of a text is at its place.
const char* anchor_of(double align) {
  return align < 0.25 ? "start" : align > 0.75 ? "end" : "middle";
}

}  // namespace

SvgDevice::SvgDevice(std::ostream& out, double width, double height, const std::string& font,
                     const std::string& title, const std::string& description)
    : text_(out) {
  text_.add("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
  text_.add(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" "
      "role=\"img\" width=\"{0:.7g}\" "
      "height=\"{1:.7g}\" viewBox=\"0 0 {0:.7g} {1:.7g}\" font-family=\"{2}\">\n",
      width, height, xml_text(font));
  text_.add("<title>{}</title>\n<desc>{}</desc>\n<g>\n", xml_text(title), xml_text(description));
}

SvgDevice::~SvgDevice() { text_.add("</g>\n</svg>\n"); }

void SvgDevice::add_path(std::span<const ChartPoint> points, bool closed) {
  char command = 'M';
  for (const ChartPoint& point : points) {
    const ChartPoint at = placed(point);
    text_.add("{}{:.6g} {:.6g}", command, at.x, at.y);
    command = 'L';
  }
  text_.add("{}", closed ? "Z" : "");
}

void SvgDevice::fill(std::span<const ChartPoint> corners, const ChartColor& color) {
  text_.add("<path fill=\"{}\" d=\"", hex(color));
  add_path(corners, true);
  text_.add("\"/>\n");
}

void SvgDevice::stroke(std::span<const ChartPoint> points, bool closed, const ChartColor& color,
                       double width, std::span<const double> dashes) {
  text_.add("<path fill=\"none\" stroke=\"{}\" stroke-width=\"{:.6g}\" stroke-linejoin=\"round\"",
            hex(color), width);
  if (!dashes.empty()) {
    text_.add(" stroke-dasharray=\"");
    for (const double length : dashes) {
      text_.add("{:.6g} ", length);
    }
    text_.add("\"");
  }
  text_.add(" d=\"");
  add_path(points, closed);
  text_.add("\"/>\n");
}

void SvgDevice::text(const std::string& text, const ChartPoint& at, double align,
                     const ChartText& look, bool upward) {
  if (text.empty()) {
    return;
  }
  constexpr double middle = 0.35;  // height of the letters' middle, fraction of the font's size
  const ChartPoint place = placed(at);
  text_.add("<text x=\"{:.6g}\" y=\"{:.6g}\" font-size=\"{:.6g}\" fill=\"{}\"", place.x,
            place.y + (upward ? 0 : middle * look.size), look.size, hex(look.color));
  if (align != 0) {
    text_.add(" text-anchor=\"{}\"", anchor_of(align));
  }
  if (look.bold) {
    text_.add(" font-weight=\"bold\"");
  }
  if (upward) {
    text_.add(" transform=\"rotate(-90 {0:.6g} {1:.6g}) translate(0 {2:.6g})\"", place.x, place.y,
              middle * look.size);
  }
  text_.add(">{}</text>\n", xml_text(text));
}

void SvgDevice::clip(const ChartArea& area) {
  const ChartPoint corner = placed({area.left, area.top});
  text_.add(
      "</g>\n<clipPath id=\"area{0}\"><rect x=\"{1:.6g}\" y=\"{2:.6g}\" width=\"{3:.6g}\" "
      "height=\"{4:.6g}\"/></clipPath>\n<g clip-path=\"url(#area{0})\">\n",
      ++clips_, corner.x, corner.y, area.right - area.left, area.bottom - area.top);
}

void SvgDevice::clip_nothing() { text_.add("</g>\n<g>\n"); }

void SvgDevice::image(const ChartArea& area, const std::string& png) {
  const ChartPoint corner = placed({area.left, area.top});
  text_.add(
      "<image x=\"{:.6g}\" y=\"{:.6g}\" width=\"{:.6g}\" height=\"{:.6g}\" "
      "preserveAspectRatio=\"none\" xlink:href=\"data:image/png;base64,{}\"/>\n",
      corner.x, corner.y, area.right - area.left, area.bottom - area.top, to_base64(png));
}

}  // namespace transillum
