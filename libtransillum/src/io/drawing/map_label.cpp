// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "io/drawing/map_label.h"

namespace transillum {

void draw_map_label(cairo_t* cairo, const PlacedLabel& label) {
  cairo_select_font_face(cairo, label_font, CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_BOLD);
  cairo_set_font_size(cairo, label_size);
  cairo_text_extents_t extents;
  cairo_text_extents(cairo, label.text.c_str(), &extents);
  cairo_set_source_rgb(cairo, 1, 1, 1);
  cairo_set_line_width(cairo, 2);
  cairo_move_to(cairo, label.point.x, label.point.y);
  cairo_line_to(cairo, label.base.x, label.base.y);
  cairo_stroke(cairo);
  cairo_arc(cairo, label.point.x, label.point.y, 3, 0, 7);
  cairo_fill(cairo);
  const double begin = label.base.x - (label.ends_at ? extents.x_advance : 0);
  cairo_move_to(cairo, begin, label.base.y);
  cairo_text_path(cairo, label.text.c_str());
  cairo_set_source_rgb(cairo, 0, 0, 0);
  cairo_set_line_width(cairo, 4);
  cairo_stroke(cairo);
  cairo_move_to(cairo, begin, label.base.y);
  cairo_set_source_rgb(cairo, 1, 1, 1);
  cairo_show_text(cairo, label.text.c_str());
}

}  // namespace transillum
