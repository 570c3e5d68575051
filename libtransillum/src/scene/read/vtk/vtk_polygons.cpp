// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// From the polygons of a VTK file to a SceneDescription. Input: the arrays that vtp_reader and
// vtk_reader have decoded.
#include "scene/read/vtk/vtk_polygons.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <tuple>

#include "scene/build/description_check.h"
#include "scene/build/warnings.h"
#include "scene/read/face_materials.h"
#include "scene/read/texture_average.h"
#include "transillum/at.h"
#include "transillum/errors.h"

namespace transillum {
namespace {

const VtkArray* find(const std::vector<VtkArray>& arrays, const std::string& name,
                     std::size_t components) {
  const auto found = std::find_if(arrays.begin(), arrays.end(), [&](const VtkArray& array) {
    return array.name == name && array.components == components;
  });
  return found == arrays.end() ? nullptr : &*found;
}

/// Colors in bytes: the array to show, else the first.
const VtkArray* colors_of(const std::vector<VtkArray>& arrays, const std::string& shown) {
  const VtkArray* first = nullptr;
  for (const VtkArray& array : arrays) {
    if (!array.has_bytes || (array.components != 3 && array.components != 4)) {
      continue;
    }
    if (array.name == shown) {
      return &array;
    }
    first = first == nullptr ? &array : first;
  }
  return first;
}

/// The numbers of faces that a result has: whole and ascending. Nothing in files without a result's
/// reflectance and emission, whose array of this name means something else.
const VtkArray* faces_of(const VtkPolygons& file) {
  const VtkArray* faces = find(file.of_cells, "face", 1);
  const bool is_result =
      find(file.of_cells, "rho", 3) != nullptr && find(file.of_cells, "E", 3) != nullptr;
  if (faces == nullptr || !is_result || faces->values.size() < file.other_cells) {
    return nullptr;
  }
  constexpr double most = std::numeric_limits<std::int32_t>::max() - 1;
  double least = 0;
  for (std::size_t k = file.other_cells; k < faces->values.size(); ++k) {
    const double face = faces->values[k];
    if (!(face >= least && face <= most && face == std::floor(face))) {
      return nullptr;
    }
    least = face;
  }
  return faces;
}

/// With blanks for control characters.
std::string without_controls(std::string name) {
  std::replace_if(
      name.begin(), name.end(),
      [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }, ' ');
  return name;
}

class SceneOfPolygons {
 public:
  SceneOfPolygons(const VtkPolygons& file, const ReadOptions& options,
                  const Cancellation& cancellation)
      : file_(file),
        options_(options),
        cancellation_(cancellation),
        rho_(find(file.of_cells, "rho", 3)),
        exitance_(find(file.of_cells, "E", 3)),
        material_(find(file.of_cells, "material", 1)),
        group_(file.groups.empty() ? nullptr : find(file.of_cells, "group", 1)),
        face_(faces_of(file)),
        cell_colors_(colors_of(file.of_cells, file.cell_scalars)),
        point_colors_(colors_of(file.of_points, file.point_scalars)) {
    description_.name = file.name;
    description_.files = {file.name};
    for (const std::string& group : file.groups) {
      description_.groups.push_back(without_controls(group));
    }
    materials_.emplace(description_, options);
  }

  SceneDescription build() {
    check_sizes(file_.of_cells,
                file_.other_cells + file_.polygons.ends.size() + file_.strips.ends.size());
    check_sizes(file_.of_points, file_.points.size() / 3);
    add_points();
    std::size_t cell = file_.other_cells;
    add_cells(file_.polygons, cell, [&](std::span<const PointId> outline) { add_face(outline); });
    add_cells(file_.strips, cell, [&](std::span<const PointId> strip) {
      for (std::size_t k = 0; k + 2 < strip.size(); ++k) {
        const std::array<PointId, 3> triangle{strip[k], strip[k + 1 + k % 2], strip[k + 2 - k % 2]};
        add_face(triangle);
      }
    });
    if (description_.face_count() == 0) {
      throw InputError(file_.name + ": has no polygons");
    }
    if (file_.other_cells > 0) {
      notes_.add("notes", fmt::format("{}: {} vertices and lines are no polygons; omitted",
                                      file_.name, file_.other_cells));
    }
    materials_->note(notes_, "");
    description_.notes = notes_.sentences();
    return std::move(description_);
  }

 private:
  void check_sizes(const std::vector<VtkArray>& arrays, std::size_t entries) const {
    for (const VtkArray& array : arrays) {
      if (array.values.size() != array.components * entries) {
        throw InputError(fmt::format("{}: an array of data has {} numbers, not {} times {}",
                                     file_.name, array.values.size(), entries, array.components));
      }
    }
  }

  void add_points() {
    for (std::size_t k = 0; k + 2 < file_.points.size(); k += 3) {
      const Vec3 p{file_.points[k], file_.points[k + 1], file_.points[k + 2]};
      if (!is_finite(p) || max_abs(p) > largest_coordinate) {
        throw InputError(fmt::format("{}: point {} is not a finite point of at most {}", file_.name,
                                     k / 3, largest_coordinate));
      }
      description_.points.push_back(p);
    }
  }

  template <class Add>
  void add_cells(const VtkCells& cells, std::size_t& cell, Add add) {
    const auto size = static_cast<std::int64_t>(cells.points.size());
    std::int64_t begin = 0;
    std::vector<PointId> outline;
    for (const std::int64_t end : cells.ends) {
      cell_ = cell++;
      if (cell_ % 4096 == 0) {
        cancellation_.throw_if_canceled();
      }
      if (end < begin || end > size) {
        fail(fmt::format("its points end at {}, which is not in the range {} to {}", end, begin,
                         size));
      }
      outline.clear();
      for (; begin < end; ++begin) {
        outline.push_back(checked_point(at(cells.points, begin)));
      }
      add(std::span<const PointId>(outline));
    }
  }

  PointId checked_point(std::int64_t p) const {
    const auto count = static_cast<std::int64_t>(description_.points.size());
    if (p < 0 || p >= count || p > std::numeric_limits<PointId>::max() - 1) {
      fail(fmt::format("point {} does not exist; there are {}", p, count));
    }
    return static_cast<PointId>(p);
  }

  void add_face(std::span<const PointId> outline) {
    description_.add_face(outline, material_of(outline), 0, group_of_cell());
    if (face_ != nullptr) {
      description_.face_number.push_back(static_cast<std::int32_t>(at(face_->values, cell_)));
    }
  }

  std::int32_t material_of(std::span<const PointId> outline) {
    Rgb light;
    if (exitance_ != nullptr) {
      light = color_at(*exitance_, cell_);
      check_exitance(light, place());
    }
    if (rho_ != nullptr) {
      return given_material(color_at(*rho_, cell_), light);
    }
    if (cell_colors_ != nullptr) {
      return materials_->of_color(shown_color(*cell_colors_, cell_), light);
    }
    if (point_colors_ != nullptr && !outline.empty()) {
      Rgb sum;
      for (const PointId p : outline) {
        sum += shown_color(*point_colors_, static_cast<std::size_t>(p));
      }
      return materials_->of_mean_color(1 / static_cast<double>(outline.size()) * sum, light);
    }
    if (exitance_ != nullptr) {
      const double rho = options_.default_reflectance;
      return given_material({rho, rho, rho}, light);
    }
    return materials_->without_color();
  }

  /// Cells with the same material number, E and rho share a material.
  std::int32_t given_material(Rgb rho, const Rgb& exitance) {
    const std::int64_t number = whole_number(material_);
    const auto next = static_cast<std::int32_t>(description_.materials.size());
    const auto [entry, is_new] = numbers_.try_emplace(
        {number, {rho.r, rho.g, rho.b, exitance.r, exitance.g, exitance.b}}, next);
    if (!is_new) {
      return entry->second;
    }
    const std::string name = number >= 0 && number < std::ssize(file_.materials)
                                 ? without_controls(at(file_.materials, number))
                                 : fmt::format("material {}", next + 1);
    for (const double channel : {rho.r, rho.g, rho.b}) {
      if (!(channel >= 0) || !std::isfinite(channel)) {
        fail(fmt::format("rho {} is not a finite number of at least 0", channel));
      }
    }
    const Rgb given = rho;
    lower_reflectance(rho, options_);
    if (rho != given) {
      notes_.add("reflectances, lowered",
                 fmt::format("{}: material {} has rho {} {} {}; lowered to {} {} {}", file_.name,
                             name, given.r, given.g, given.b, rho.r, rho.g, rho.b));
    }
    description_.materials.push_back({name, rho, exitance});
    return next;
  }

  std::int32_t group_of_cell() const {
    const std::int64_t group = whole_number(group_);
    if (group_ == nullptr || group == no_group) {
      return no_group;
    }
    if (group < 0 || group >= std::ssize(file_.groups)) {
      fail(fmt::format("group {} is not in the range -1 to {}", group,
                       std::ssize(file_.groups) - 1));
    }
    return static_cast<std::int32_t>(group);
  }

  /// The number of the cell; -1 where it is no whole number.
  std::int64_t whole_number(const VtkArray* array) const {
    if (array == nullptr) {
      return -1;
    }
    const double value = at(array->values, cell_);
    return std::abs(value) <= 0x1p31 && value == std::floor(value)
               ? static_cast<std::int64_t>(value)
               : -1;
  }
  static Rgb color_at(const VtkArray& array, std::size_t k) {
    const std::size_t first = k * array.components;
    return {at(array.values, first), at(array.values, first + 1), at(array.values, first + 2)};
  }
  static Rgb shown_color(const VtkArray& array, std::size_t k) {
    const auto channel = [](double v) {
      return linear_of_srgb(static_cast<std::uint8_t>(v >= 0 ? std::min(v, 255.0) : 0.0));
    };
    const Rgb c = color_at(array, k);
    return {channel(c.r), channel(c.g), channel(c.b)};
  }

  std::string place() const { return fmt::format("{}: cell {}: ", file_.name, cell_); }
  [[noreturn]] void fail(const std::string& what) const { throw InputError(place() + what); }

  const VtkPolygons& file_;
  const ReadOptions& options_;
  const Cancellation& cancellation_;
  const VtkArray *rho_, *exitance_, *material_, *group_, *face_, *cell_colors_, *point_colors_;
  SceneDescription description_;
  std::optional<FaceMaterials> materials_;
  std::map<std::tuple<std::int64_t, std::array<double, 6>>, std::int32_t> numbers_;
  Warnings notes_;
  std::size_t cell_ = 0;  ///< that is read
};

}  // namespace

bool is_read_by_scenes(const std::string& name, std::size_t components, bool has_bytes) {
  return (components == 3 && (name == "rho" || name == "E")) ||
         (components == 1 && (name == "material" || name == "group" || name == "face")) ||
         (has_bytes && (components == 3 || components == 4));
}

SceneDescription scene_of(const VtkPolygons& polygons, const ReadOptions& options,
                          const Cancellation& cancellation) {
  return SceneOfPolygons(polygons, options, cancellation).build();
}

}  // namespace transillum
