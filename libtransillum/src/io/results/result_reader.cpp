// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Reads a solution from a .vtp file that write_result_vtp() wrote; data/FILES.md lists its arrays.
// All values are checked: a damaged file gives an InputError.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <span>
#include <tuple>
#include <type_traits>

#include "base/text_file.h"
#include "io/results/result_values.h"
#include "io/text.h"
#include "scene/read/vtk/vtp_file.h"
#include "transillum/at.h"
#include "transillum/errors.h"
#include "transillum/files.h"

namespace transillum {
namespace {

/// Builds a Solution from the arrays of a .vtp file, which are checked when they are read.
class ResultReader {
 public:
  ResultReader(const std::filesystem::path& path, const Cancellation& cancellation)
      : file_(path, cancellation), cancellation_(cancellation) {}

  Solution read() {
    if (file_.polygons() != file_.cells()) {
      file_.fail("must contain polygons only");
    }
    Solution solution;
    visit_values(solution, [this](const char* name, auto& value) { read_value(name, value); });
    solution.scene = make_scene();
    solution.statistics.patches = solution.scene->patch_count();
    solution.radiosity = colors("B");
    solution.irradiance = colors("H");
    solution.form_factor_sums = fractions("F_sum");
    solution.sky_fractions = fractions("sky");
    if (file_.has("CellData", "H_sky")) {
      solution.sky_irradiance = colors("H_sky");
    }
    solution.sky = read_sky();
    if (solution.error.replicas > 0) {
      solution.error.standard_error = colors("standard_error");
    }
    read_steps(solution.statistics.iteration_records);
    if (file_.has("CellData", "B1")) {
      const std::vector<Rgb> first = colors("B1"), second = colors("B2");
      for (std::size_t i = 0; i < first.size(); ++i) {
        solution.linear_terms.push_back({first[i], second[i]});
      }
    }
    return solution;
  }

 private:
  template <class Number>
  void read_value(const char* name, Number& value) const {
    if (!file_.has("FieldData", name)) {
      return;
    }
    const double number = file_.numbers("FieldData", name, 1, 1).front();
    if constexpr (std::is_integral_v<Number>) {
      const double max_value = std::is_same_v<Number, bool>  ? 1
                               : std::is_same_v<Number, int> ? 0x1p30
                                                             : 0x1p53;
      if (!(number >= 0 && number <= max_value && number == std::floor(number))) {
        file_.fail(
            fmt::format("{} is {}, not a whole number from 0 to {:.0f}", name, number, max_value));
      }
    }
    value = static_cast<Number>(number);
  }

  /// The sky of the solve; none where the file does not say.
  Sky read_sky() const {
    Sky sky;
    if (!file_.has("FieldData", "sky_exitance")) {
      return sky;
    }
    const std::vector<double> e = file_.numbers("FieldData", "sky_exitance", 3, 1);
    const std::vector<double> up = file_.numbers("FieldData", "sky_up", 3, 1);
    const std::vector<std::string> model = strings("sky_model");
    sky.exitance = {e[0], e[1], e[2]};
    sky.up = {up[0], up[1], up[2]};
    if (file_.has("FieldData", "sun_irradiance")) {
      const std::vector<double> w = file_.numbers("FieldData", "sun_irradiance", 3, 1);
      const std::vector<double> d = file_.numbers("FieldData", "sun_direction", 3, 1);
      sky.sun = {{w[0], w[1], w[2]},
                 {d[0], d[1], d[2]},
                 file_.numbers("FieldData", "sun_disc", 1, 1).front() != 0};
    }
    try {
      sky.model = from_name<SkyModel>(model.empty() ? "" : model.front());
      sky.validate();
    } catch (const InputError& error) {
      file_.fail(error.what());
    }
    return sky;
  }

  void read_steps(std::vector<IterationRecord>& steps) const {
    if (!file_.has("FieldData", "change")) {
      return;
    }
    const std::size_t count = file_.size_of_field("change");
    const std::vector<double> changes = file_.numbers("FieldData", "change", 1, count);
    const std::vector<double> contractions = file_.numbers("FieldData", "contraction", 1, count);
    for (std::size_t k = 0; k < count; ++k) {
      steps.push_back({changes[k], contractions[k], 0});
    }
  }

  std::vector<Rgb> colors(const char* name) const {
    const std::vector<double> numbers = file_.numbers("CellData", name, 3, file_.polygons());
    std::vector<Rgb> colors(file_.polygons());
    for (std::size_t i = 0; i < colors.size(); ++i) {
      const double* rgb = &numbers[3 * i];
      if (!std::isfinite(rgb[0]) || !std::isfinite(rgb[1]) || !std::isfinite(rgb[2])) {
        file_.fail(fmt::format("{} of patch {} is not a finite number", name, i));
      }
      colors[i] = {rgb[0], rgb[1], rgb[2]};
    }
    return colors;
  }

  /// One number >= 0 per patch; empty: the file does not say.
  std::vector<double> fractions(const char* name) const {
    if (!file_.has("CellData", name)) {
      return {};
    }
    std::vector<double> values = file_.numbers("CellData", name, 1, file_.polygons());
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (!(values[i] >= 0) || !std::isfinite(values[i])) {
        file_.fail(fmt::format("{} of patch {} is {}, not a finite number of at least 0", name, i,
                               values[i]));
      }
    }
    return values;
  }

  std::vector<std::string> strings(const char* name) const {
    if (!file_.has("FieldData", name)) {
      return {};
    }
    std::vector<std::string> texts = file_.strings(name);
    for (std::string& text : texts) {
      text = clean_text(text);
    }
    return texts;
  }

  /// Patches with the same material number, E and rho share a material.
  void add_materials(SceneDescription& description, std::vector<std::int32_t>& of_patch) const {
    const std::vector<Rgb> exitance = colors("E"), reflectance = colors("rho");
    const std::vector<std::string> names = strings("materials");
    std::vector<std::int64_t> numbers(file_.polygons());
    if (file_.has("CellData", "material")) {
      numbers = file_.whole_numbers("CellData", "material", numbers.size());
    }
    const auto channels = [](const Rgb& c) { return std::array{c.r, c.g, c.b}; };
    using Channels = std::array<double, 3>;
    std::map<std::tuple<std::int64_t, Channels, Channels>, std::int32_t> index_of;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const auto next = static_cast<std::int32_t>(description.materials.size());
      const auto [entry, is_new] =
          index_of.try_emplace({numbers[i], channels(exitance[i]), channels(reflectance[i])}, next);
      of_patch.push_back(entry->second);
      if (!is_new) {
        continue;
      }
      const bool named = numbers[i] >= 0 && numbers[i] < static_cast<std::int64_t>(names.size());
      description.materials.push_back(
          {named ? at(names, numbers[i]) : fmt::format("material {}", next + 1), reflectance[i],
           exitance[i]});
    }
  }

  void add_points(SceneDescription& description) const {
    const std::vector<double> numbers = file_.numbers("Points", "Points", 3, file_.points());
    for (std::size_t p = 0; p < numbers.size(); p += 3) {
      description.points.push_back({numbers[p], numbers[p + 1], numbers[p + 2]});
    }
  }

  /// The outlines of all polygons, one after the other, and where each ends.
  struct Outlines {
    std::vector<PointId> corners;
    std::vector<std::int64_t> end;

    std::span<const PointId> operator[](std::size_t i) const {
      const auto from = static_cast<std::size_t>(i > 0 ? end[i - 1] : 0);
      return {corners.data() + from, static_cast<std::size_t>(end[i]) - from};
    }
  };

  Outlines read_outlines() const {
    Outlines outlines;
    outlines.end = file_.whole_numbers("Polys", "offsets", file_.polygons());
    std::int64_t before = 0;
    for (const std::int64_t end : outlines.end) {
      if (end < before || end > std::numeric_limits<std::int32_t>::max()) {
        file_.fail(fmt::format("a polygon's corners end at {}, which is not in the range {} to {}",
                               end, before, std::numeric_limits<std::int32_t>::max()));
      }
      before = end;
    }
    const auto count = static_cast<std::size_t>(outlines.end.back());
    const auto points = static_cast<std::int64_t>(file_.points());
    for (const std::int64_t p : file_.whole_numbers("Polys", "connectivity", count)) {
      if (p < 0 || p >= points) {
        file_.fail(
            fmt::format("a polygon's corner is point {}, not in the range 0 to {}", p, points - 1));
      }
      outlines.corners.push_back(static_cast<PointId>(p));
    }
    return outlines;
  }

  /// The face in the scene's file that each polygon is a part of; empty: the file does not say.
  std::vector<std::int32_t> read_faces() const {
    if (!file_.has("CellData", "face")) {
      return {};
    }
    // Faces without area have no patch, but most faces have one.
    const auto most = static_cast<std::int64_t>(64 * file_.polygons() + (std::size_t{1} << 24));
    std::vector<std::int32_t> faces;
    for (const std::int64_t face : file_.whole_numbers("CellData", "face", file_.polygons())) {
      const std::int64_t least = faces.empty() ? 0 : faces.back();
      if (face < least || face > most || face > std::numeric_limits<std::int32_t>::max()) {
        file_.fail(fmt::format("patch {} is of face {}, which is not in the range {} to {}",
                               faces.size(), face, least, most));
      }
      faces.push_back(static_cast<std::int32_t>(face));
    }
    return faces;
  }

  /// The group of each polygon, index into the names of groups or no_group; empty: the file does
  /// not say.
  std::vector<std::int32_t> read_groups(std::size_t names) const {
    if (!file_.has("CellData", "group")) {
      return {};
    }
    std::vector<std::int32_t> groups;
    for (const std::int64_t group : file_.whole_numbers("CellData", "group", file_.polygons())) {
      if (group < no_group || group >= static_cast<std::int64_t>(names)) {
        file_.fail(fmt::format("patch {} is of group {}, which is not in the range -1 to {}",
                               groups.size(), group, static_cast<std::int64_t>(names) - 1));
      }
      groups.push_back(static_cast<std::int32_t>(group));
    }
    return groups;
  }

  /// One patch per polygon; in a two-sided scene, two polygons are the sides of one face.
  std::shared_ptr<const Scene> make_scene() const {
    SceneDescription description;
    description.faces_are_patches = true;
    const std::vector<std::string> names = strings("scene");
    description.name = names.size() == 1 && !names.front().empty() ? names.front() : file_.name();
    add_points(description);
    std::vector<std::int32_t> materials;
    add_materials(description, materials);
    bool two_sided = false;
    read_value("two_sided", two_sided);
    const Outlines outlines = read_outlines();
    const std::vector<std::int32_t> faces = read_faces();
    description.groups = strings("groups");
    const std::vector<std::int32_t> groups = read_groups(description.groups.size());
    for (std::size_t i = 0; i < file_.polygons(); ++i) {
      if (i % 4096 == 0) {
        cancellation_.throw_if_canceled();
      }
      const auto outline = outlines[i];
      description.add_face(outline, materials[i], 0, groups.empty() ? no_group : groups[i]);
      if (!faces.empty()) {
        description.face_number.push_back(faces[i]);
      }
      if (!two_sided) {
        continue;
      }
      ++i;
      // By their places: with linear functions, each side has points of its own.
      const auto same_place = [&](PointId p, PointId q) {
        return at(description.points, p) == at(description.points, q);
      };
      if (i == file_.polygons() || materials[i] != materials[i - 1] ||
          !std::equal(outline.rbegin(), outline.rend(), outlines[i].begin(), outlines[i].end(),
                      same_place)) {
        file_.fail(
            fmt::format("is two-sided, but patch {} is not followed by its other side", i - 1));
      }
    }
    return checked(description, {.two_sided = two_sided});
  }

  std::shared_ptr<const Scene> checked(const SceneDescription& description,
                                       const SceneOptions& options) const {
    std::shared_ptr<const Scene> scene;
    try {
      scene = std::make_shared<const Scene>(description, options, cancellation_);
    } catch (const InputError& error) {
      if (description.name == file_.name()) {
        throw;
      }
      file_.fail(error.what());
    }
    if (static_cast<std::size_t>(scene->patch_count()) != file_.polygons()) {
      const auto& warnings = scene->report().warnings;
      file_.fail(warnings.empty() ? "some of its polygons are not valid patches"
                                  : warnings.front());
    }
    return scene;
  }

  const VtpFile file_;
  const Cancellation& cancellation_;
};

/// Whether a file that can be read says before its appended data that it has no array B.
bool is_scene_of_vtk(const std::filesystem::path& path) {
  constexpr std::size_t stride = 1 << 16;
  const std::string name = "Name=\"B\"", end = "<AppendedData";
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) {
    return false;
  }
  std::ifstream in(path, std::ios::binary);
  std::string text;
  for (std::vector<char> block(stride); in;) {
    in.read(block.data(), static_cast<std::streamsize>(stride));
    text.append(block.data(), static_cast<std::size_t>(in.gcount()));
    const std::size_t data = text.find(end);
    if (text.find(name) < data) {
      return false;
    }
    if (data != std::string::npos) {
      return true;
    }
    text.erase(0, text.size() - std::min(text.size(), end.size()));
  }
  return in.eof();
}

}  // namespace

bool is_result_file(const std::filesystem::path& path) {
  return lower_case_ending(path) == ".vtp" && !is_scene_of_vtk(path);
}

Solution read_result(const std::filesystem::path& path, const Cancellation& cancellation) {
  return ResultReader(path, cancellation).read();
}

}  // namespace transillum
