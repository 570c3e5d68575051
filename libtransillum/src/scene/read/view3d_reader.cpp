// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// A line of a View3D file begins with a letter: V defines a vertex, S a surface of three or four of
// them, O one that only obstructs, N one that only cuts its base. After the geometry, a surface has
// the number of its base, the number of the surface it is combined with, its emissivity and its
// name. In the format 3a, a surface has a shape instead of vertices, and the next line has the
// origin of its plane, azimuth and tilt in degrees, and the shape in the plane.
#include "scene/read/scene_readers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "base/text_file.h"
#include "scene/build/description_check.h"
#include "scene/build/warnings.h"
#include "scene/read/face_materials.h"
#include "transillum/at.h"
#include "transillum/errors.h"

namespace transillum {
namespace {

using Polygon = std::vector<Vec3>;

Vec3 area_of(const Polygon& polygon) {
  Vec3 doubled;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    doubled =
        doubled + cross(polygon[k] - polygon[0], polygon[(k + 1) % polygon.size()] - polygon[0]);
  }
  return doubled;
}

/// The part of a convex polygon on one side of the line a, b in its plane: to the left, seen from
/// the front, or to the right.
Polygon side_of(const Polygon& polygon, const Vec3& a, const Vec3& b, const Vec3& normal,
                bool left) {
  const Vec3 inward = cross(normal, b - a);
  const double size = norm(inward) * (norm(b - a) + norm(polygon[0] - a));
  Polygon part;
  const auto height = [&](const Vec3& p) {
    const double h = (left ? 1.0 : -1.0) * dot(inward, p - a);
    return std::abs(h) <= 1e-12 * size ? 0.0 : h;
  };
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec3 &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
    const double from = height(p), to = height(q);
    if (from >= 0) {
      part.push_back(p);
    }
    if ((from > 0 && to < 0) || (from < 0 && to > 0)) {
      part.push_back(p + from / (from - to) * (q - p));
    }
  }
  const bool any =
      std::any_of(part.begin(), part.end(), [&](const Vec3& p) { return height(p) > 0; });
  return any ? part : Polygon();
}

bool is_convex(const Polygon& polygon) {
  const Vec3 normal = area_of(polygon);
  const std::size_t n = polygon.size();
  for (std::size_t k = 0; k < n; ++k) {
    const Vec3 &a = polygon[k], &b = polygon[(k + 1) % n], &c = polygon[(k + 2) % n];
    if (dot(cross(b - a, c - b), normal) < 0) {
      return false;
    }
  }
  return true;
}

/// Cosine and sine of an angle in degrees, exact for right angles.
std::array<double, 2> direction_of(double degrees) {
  const double quarters = std::fmod(degrees, 360) / 90;
  if (quarters == std::floor(quarters)) {
    constexpr std::array<double, 4> cosines{1, 0, -1, 0};
    const auto q = static_cast<std::size_t>(quarters + 4) % 4;
    return {cosines[q], cosines[(q + 3) % 4]};
  }
  const double angle = degrees * std::numbers::pi / 180;
  return {std::cos(angle), std::sin(angle)};
}

/// The plane of a surface of the format 3a: its x axis is horizontal, its y axis is upward. The
/// azimuth is clockwise from north, which is y; the tilt is 0 for a plane that faces upward.
struct ShapePlane {
  Vec3 origin, across, up;

  ShapePlane(const Vec3& corner, double azimuth, double tilt) : origin(corner) {
    const auto [cos_azimuth, sin_azimuth] = direction_of(azimuth);
    const auto [cos_tilt, sin_tilt] = direction_of(tilt);
    across = {-cos_azimuth, sin_azimuth, 0};
    up = {-cos_tilt * sin_azimuth, -cos_tilt * cos_azimuth, sin_tilt};
  }
  Vec3 point(double x, double y) const { return origin + x * across + y * up; }
};

class View3dReader {
 public:
  View3dReader(const std::filesystem::path& path, const ReadOptions& options,
               const Cancellation& cancellation)
      : options_(options),
        cancellation_(cancellation),
        text_(read_text_file(path, largest_scene_file)),
        lines_(text_, cancellation) {
    description_.name = path.string();
    description_.files = {path.string()};
  }

  SceneDescription read() {
    for (auto line = lines_.next(); line && !ended_; line = lines_.next()) {
      line_ = line->number;
      read_line(*line);
    }
    if (surfaces_.empty()) {
      throw InputError(description_.name + ": has no surfaces");
    }
    add_faces();
    description_.notes = notes_.sentences();
    return std::move(description_);
  }

 private:
  struct Surface {
    char kind = 'S';
    std::int32_t line = 0;
    Polygon outline;
    std::size_t base = 0, combined = 0;  ///< numbers from 1; 0 if there is none
    double emissivity = 1;
    std::string name;
  };

  void read_line(const TextLine& line) {
    const char kind = static_cast<char>(std::toupper(static_cast<unsigned char>(line.keyword[0])));
    // Comments reach to the end of the line.
    split_words(line.rest.substr(0, line.rest.find('!')), words_);
    switch (kind) {
      case 'V':
        return read_vertex();
      case 'S':
      case 'O':
      case 'N':
      case 'M':
        return has_shapes_ ? read_shape(kind) : read_surface(kind);
      case 'F':
        has_shapes_ = !words_.empty() && lower_case(words_[0]) == "3a";
        if (!has_shapes_ && (words_.empty() || words_[0] != "3")) {
          fail("only geometry in three dimensions (F 3 or F 3a) can be read");
        }
        return;
      case 'E':
      case '*':
        ended_ = true;
        return;
      case 'T':
      case 'C':
      case '!':
      case '/':
        return;
      default:
        notes_.add("lines of unknown kinds, ignored",
                   fmt::format("{}:{}: {} is not a kind of line of View3D; line ignored",
                               description_.name, line_, in_quotes(line.keyword)));
    }
  }

  double number(std::size_t word, const char* what) const {
    const std::optional<double> value =
        word < words_.size() ? parse_number(words_[word]) : std::nullopt;
    if (!value) {
      fail(fmt::format("{} must be a number", what));
    }
    return *value;
  }

  /// A whole number of 0 to `most`.
  std::size_t index(std::size_t word, std::size_t most, const char* what) const {
    std::size_t value = 0;
    if (word < words_.size()) {
      const std::string_view text = words_[word];
      const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
      if (error == std::errc() && end == text.data() + text.size() && value <= most) {
        return value;
      }
    }
    fail(fmt::format("{} must be a whole number of at most {}", what, most));
  }

  void read_vertex() {
    if (index(0, points_.size() + 1, "the vertex's number") != points_.size() + 1) {
      fail(fmt::format("vertices must be numbered in order; the next is {}", points_.size() + 1));
    }
    const Vec3 p{number(1, "x"), number(2, "y"), number(3, "z")};
    check_point(p);
    points_.push_back(p);
  }

  void check_point(const Vec3& p) const {
    if (!is_finite(p) || max_abs(p) > largest_coordinate) {
      fail(fmt::format("not a finite point of at most {}", largest_coordinate));
    }
  }

  Surface numbered_surface(char kind) const {
    if (index(0, surfaces_.size() + 1, "the surface's number") != surfaces_.size() + 1) {
      fail(fmt::format("surfaces must be numbered in order; the next is {}", surfaces_.size() + 1));
    }
    Surface surface;
    surface.kind = kind;
    surface.line = line_;
    surface.name = fmt::format("surface {}", surfaces_.size() + 1);
    return surface;
  }

  void read_surface(char kind) {
    Surface surface = numbered_surface(kind);
    for (std::size_t k = 1; k <= 4; ++k) {
      const std::size_t v = index(k, points_.size(), "a vertex of a surface");
      if (v == 0 && k < 4) {
        fail("a surface must have three vertices at least");
      }
      if (v > 0) {
        surface.outline.push_back(points_[v - 1]);
      }
    }
    read_uses(surface, 5);
    surfaces_.push_back(std::move(surface));
  }

  /// Reads what follows the geometry, from this word on.
  void read_uses(Surface& surface, std::size_t first) const {
    if (words_.size() > first) {
      surface.base = index(first, surfaces_.size(), "the base");
    }
    if (words_.size() > first + 1) {
      surface.combined = index(first + 1, surfaces_.size(), "the surface to combine with");
    }
    if (words_.size() > first + 2) {
      surface.emissivity = number(first + 2, "the emissivity");
      if (!(surface.emissivity >= 0 && surface.emissivity <= 1)) {
        fail("the emissivity must be in the range 0 to 1");
      }
    }
    if (words_.size() > first + 3) {
      surface.name = words_[first + 3];
    }
  }

  void read_shape(char kind) {
    Surface surface = numbered_surface(kind);
    const std::string shape = words_.size() > 1 ? lower_case(words_[1]) : std::string();
    const std::size_t corners = shape == "t" ? 3 : shape == "r" || shape == "q" ? 4 : 0;
    if (corners == 0) {
      fail(
          fmt::format("{} is no shape; shapes are R (rectangle), Q (quadrilateral) and T "
                      "(triangle)",
                      in_quotes(words_.size() > 1 ? words_[1] : std::string_view())));
    }
    if (kind != 'O') {
      read_uses(surface, 2);
    }
    const bool is_rectangle = shape == "r";
    const std::vector<double> v = shape_numbers(is_rectangle ? 7 : 5 + 2 * corners);
    const ShapePlane plane({v[0], v[1], v[2]}, v[3], v[4]);
    if (is_rectangle) {
      for (const std::size_t k : {5, 6}) {
        if (!(v[k] > 0)) {
          fail(fmt::format("the {} must be above 0", k == 5 ? "width" : "height"));
        }
      }
      surface.outline = {plane.point(0, v[6]), plane.point(0, 0), plane.point(v[5], 0),
                         plane.point(v[5], v[6])};
    } else {
      for (std::size_t k = 5; k < v.size(); k += 2) {
        surface.outline.push_back(plane.point(v[k], v[k + 1]));
      }
    }
    for (const Vec3& p : surface.outline) {
      check_point(p);
    }
    surfaces_.push_back(std::move(surface));
  }

  /// The numbers of a shape, which may be on several lines.
  std::vector<double> shape_numbers(std::size_t count) {
    constexpr std::array<const char*, 5> names{"x", "y", "z", "the azimuth", "the tilt"};
    std::vector<double> numbers;
    while (numbers.size() < count) {
      const std::optional<TextLine> line = lines_.next();
      if (!line) {
        fail("the file ends within the surface");
      }
      line_ = line->number;
      // The first word of such a line is a number too.
      const std::string text = fmt::format("{} {}", line->keyword, line->rest);
      split_words(std::string_view(text).substr(0, text.find('!')), words_);
      for (std::size_t w = 0; w < words_.size() && numbers.size() < count; ++w) {
        const std::size_t n = numbers.size();
        numbers.push_back(number(w, n < names.size() ? names[n] : "a coordinate"));
      }
    }
    return numbers;
  }

  void add_faces() {
    std::vector<std::vector<std::size_t>> cuts(surfaces_.size());
    for (std::size_t s = 0; s < surfaces_.size(); ++s) {
      if (surfaces_[s].base > 0) {
        cuts[surfaces_[s].base - 1].push_back(s);
      }
    }
    for (std::size_t s = 0; s < surfaces_.size(); ++s) {
      cancellation_.throw_if_canceled();
      const Surface& surface = surfaces_[s];
      if (surface.kind == 'N') {
        continue;
      }
      const std::int32_t material = material_of(surface), group = group_of(s);
      for (const Polygon& part : parts_of(surface, cuts[s])) {
        add_face(part, material, surface.line, group);
        description_.face_number.push_back(static_cast<std::int32_t>(s));
      }
    }
  }

  /// A surface without its subsurfaces, in convex parts.
  std::vector<Polygon> parts_of(const Surface& surface, const std::vector<std::size_t>& cuts) {
    std::vector<Polygon> parts{surface.outline};
    for (const std::size_t c : cuts) {
      const Polygon& hole = surfaces_[c].outline;
      if (!is_convex(surface.outline) || !is_convex(hole)) {
        notes_.add("subsurfaces that are not cut out",
                   fmt::format("{}:{}: the subsurface or its base is not convex; it is not cut out "
                               "of the base",
                               description_.name, surfaces_[c].line));
        continue;
      }
      std::vector<Polygon> left;
      for (const Polygon& part : parts) {
        subtract(part, hole, left);
      }
      parts = std::move(left);
    }
    return parts;
  }

  static void subtract(Polygon rest, const Polygon& hole, std::vector<Polygon>& outside) {
    const Vec3 normal = area_of(rest);
    const bool turned = dot(area_of(hole), normal) < 0;
    for (std::size_t k = 0; k < hole.size() && !rest.empty(); ++k) {
      const Vec3 &a = hole[k], &b = hole[(k + 1) % hole.size()];
      Polygon part = side_of(rest, a, b, normal, turned);
      if (!part.empty()) {
        outside.push_back(std::move(part));
      }
      rest = side_of(rest, a, b, normal, !turned);
    }
  }

  void add_face(const Polygon& polygon, std::int32_t material, std::int32_t line,
                std::int32_t group) {
    std::vector<PointId> outline;
    for (const Vec3& p : polygon) {
      outline.push_back(static_cast<PointId>(description_.points.size()));
      description_.points.push_back(p);
    }
    description_.add_face(outline, material, line, group);
  }

  std::int32_t material_of(const Surface& surface) {
    const bool emits = surface.kind == 'S';
    const double rho = emits ? 1 - surface.emissivity : 0;
    const auto next = static_cast<std::int32_t>(description_.materials.size());
    const auto [entry, is_new] = materials_.try_emplace(emits ? rho : -1.0, next);
    if (is_new) {
      Material material{emits ? fmt::format("emissivity {:g}", surface.emissivity) : "obstruction",
                        {rho, rho, rho},
                        {}};
      lower_reflectance(material.reflectance, options_);
      description_.materials.push_back(material);
    }
    return entry->second;
  }

  std::int32_t group_of(std::size_t s) {
    // A surface may be combined with one that is combined itself; numbers decrease.
    while (surfaces_[s].combined > 0) {
      s = surfaces_[s].combined - 1;
    }
    const auto next = static_cast<std::int32_t>(description_.groups.size());
    const auto [entry, is_new] = groups_.try_emplace(s, next);
    if (is_new) {
      const bool taken = !names_.try_emplace(surfaces_[s].name, s).second;
      description_.groups.push_back(taken ? fmt::format("{} ({})", surfaces_[s].name, s + 1)
                                          : surfaces_[s].name);
    }
    return entry->second;
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("{}:{}: {}", description_.name, line_, what));
  }

  const ReadOptions& options_;
  const Cancellation& cancellation_;
  const std::string text_;
  LineReader lines_;
  SceneDescription description_;
  Warnings notes_;
  std::int32_t line_ = 0;
  bool ended_ = false, has_shapes_ = false;
  std::vector<std::string_view> words_;
  std::vector<Vec3> points_;
  std::vector<Surface> surfaces_;
  std::map<double, std::int32_t> materials_;
  std::map<std::size_t, std::int32_t> groups_;
  std::map<std::string, std::size_t> names_;
};

}  // namespace

SceneDescription read_view3d(const std::filesystem::path& path, const ReadOptions& options,
                             const Cancellation& cancellation) {
  return View3dReader(path, options, cancellation).read();
}

}  // namespace transillum
