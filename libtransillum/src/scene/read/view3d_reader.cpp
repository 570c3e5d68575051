// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// A line of a View3D file begins with a letter: V defines a vertex, S a surface of three or four of
// them, O one that only obstructs, N one that only cuts its base. After the geometry, a surface has
// the number of its base, that of the surface that it is combined with, its emissivity and its
// name.
#include "scene/read/view3d_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <new>
#include <optional>

#include "base/text_file.h"
#include "scene/build/description_check.h"
#include "scene/build/warnings.h"
#include "scene/read/reflectance_limit.h"
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

class View3dReader {
 public:
  View3dReader(const std::filesystem::path& path, const ReadOptions& options,
               const Cancellation& cancellation)
      : options_(options),
        cancellation_(cancellation),
        text_(read_text_file(path, largest_scene_file)) {
    description_.name = path.string();
    description_.files = {path.string()};
  }

  SceneDescription read() {
    LineReader lines(text_, cancellation_);
    for (std::optional<TextLine> line = lines.next(); line && !ended_; line = lines.next()) {
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
    std::size_t base = 0, combined = 0;  ///< numbers from 1; 0: none
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
        return read_surface(kind);
      case 'F':
        if (words_.empty() || words_[0] != "3") {
          fail("only geometry in three dimensions by vertices (F 3) can be read");
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
    if (!is_finite(p) || max_abs(p) > largest_coordinate) {
      fail(fmt::format("not a finite point of at most {}", largest_coordinate));
    }
    points_.push_back(p);
  }

  void read_surface(char kind) {
    if (index(0, surfaces_.size() + 1, "the surface's number") != surfaces_.size() + 1) {
      fail(fmt::format("surfaces must be numbered in order; the next is {}", surfaces_.size() + 1));
    }
    Surface surface;
    surface.kind = kind;
    surface.line = line_;
    for (std::size_t k = 1; k <= 4; ++k) {
      const std::size_t v = index(k, points_.size(), "a vertex of a surface");
      if (v == 0 && k < 4) {
        fail("a surface must have three vertices at least");
      }
      if (v > 0) {
        surface.outline.push_back(points_[v - 1]);
      }
    }
    if (words_.size() > 5) {
      surface.base = index(5, surfaces_.size(), "the base");
    }
    if (words_.size() > 6) {
      surface.combined = index(6, surfaces_.size(), "the surface to combine with");
    }
    if (words_.size() > 7) {
      surface.emissivity = number(7, "the emissivity");
      if (!(surface.emissivity >= 0 && surface.emissivity <= 1)) {
        fail("the emissivity must be in the range 0 to 1");
      }
    }
    surface.name = words_.size() > 8 ? std::string(words_[8])
                                     : fmt::format("surface {}", surfaces_.size() + 1);
    surfaces_.push_back(std::move(surface));
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
  SceneDescription description_;
  Warnings notes_;
  std::int32_t line_ = 0;
  bool ended_ = false;
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
  try {
    return View3dReader(path, options, cancellation).read();
  } catch (const std::bad_alloc&) {
    throw InputError(path.string() + ": not enough memory");
  }
}

}  // namespace transillum
