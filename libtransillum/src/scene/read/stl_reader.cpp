// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "scene/read/scene_readers.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstring>
#include <map>
#include <optional>

#include "base/text_file.h"
#include "scene/build/description_check.h"
#include "scene/build/point_table.h"
#include "scene/build/warnings.h"
#include "scene/read/face_materials.h"
#include "transillum/errors.h"

namespace transillum {
namespace {

constexpr std::size_t header_size = 84, triangle_size = 50;

class StlReader {
 public:
  StlReader(const std::filesystem::path& path, const ReadOptions& options,
            const Cancellation& cancellation)
      : cancellation_(cancellation), bytes_(read_binary_file(path, largest_scene_file)) {
    description_.name = path.string();
    description_.files = {path.string()};
    materials_.emplace(description_, options);
  }

  SceneDescription read() {
    // The header of a binary file may begin with "solid" too; its size tells.
    if (binary_count() && header_size + triangle_size * *binary_count() == bytes_.size()) {
      read_binary(*binary_count());
    } else if (first_line().starts_with("solid")) {
      read_text();
    } else if (binary_count()) {
      throw InputError(fmt::format(
          "{}: is neither ASCII nor binary STL: {} triangles take {} bytes, the file has {}",
          description_.name, *binary_count(), header_size + triangle_size * *binary_count(),
          bytes_.size()));
    } else {
      throw InputError(description_.name + ": is not an STL file: it has no 84 bytes");
    }
    if (description_.face_count() == 0) {
      throw InputError(description_.name + ": has no triangles");
    }
    description_.points = points_.take();
    Warnings notes;
    materials_->note(notes, " (STL has none)");
    description_.notes = notes.sentences();
    return std::move(description_);
  }

 private:
  /// The beginning of the first line of text, in small letters.
  std::string first_line() const {
    constexpr std::string_view mark = "\xef\xbb\xbf";
    std::string_view all = bytes_;
    all.remove_prefix(all.starts_with(mark) ? mark.size() : 0);
    return lower_case(trimmed(all.substr(0, std::min<std::size_t>(all.find('\n'), 256))));
  }

  std::optional<std::size_t> binary_count() const {
    if (bytes_.size() < header_size) {
      return {};
    }
    std::size_t count = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      count |= std::size_t{static_cast<unsigned char>(bytes_[80 + k])} << (8 * k);
    }
    return count;
  }

  void read_binary(std::size_t count) {
    for (std::size_t t = 0; t < count; ++t) {
      if (t % 4096 == 0) {
        cancellation_.throw_if_canceled();
      }
      const char* corners = bytes_.data() + header_size + triangle_size * t + 12;
      for (std::size_t k = 0; k < 3; ++k) {
        corner_[k] = {number_at(corners + 12 * k), number_at(corners + 12 * k + 4),
                      number_at(corners + 12 * k + 8)};
      }
      add_triangle(fmt::format("{}: triangle {}: ", description_.name, t), 0);
    }
  }

  static double number_at(const char* bytes) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      bits |= std::uint32_t{static_cast<unsigned char>(bytes[k])} << (8 * k);
    }
    return static_cast<double>(std::bit_cast<float>(bits));
  }

  void read_text() {
    LineReader lines(bytes_, cancellation_);
    std::size_t corners = 0;
    while (const std::optional<TextLine> line = lines.next()) {
      const std::string keyword = lower_case(line->keyword);
      const std::string place = fmt::format("{}:{}: ", description_.name, line->number);
      if (keyword == "solid") {
        begin_solid(std::string(line->rest));
      } else if (keyword == "vertex") {
        if (corners == 3) {
          throw InputError(place + "a facet has more than three vertices");
        }
        corner_[corners++] = point_of(*line, place);
      } else if (keyword == "endloop") {
        if (corners != 3) {
          throw InputError(fmt::format("{}a facet has {} vertices instead of 3", place, corners));
        }
        add_triangle(place, line->number);
        corners = 0;
      } else if (keyword != "facet" && keyword != "outer" && keyword != "endfacet" &&
                 keyword != "endsolid" && keyword != "color") {
        throw InputError(place + in_quotes(line->keyword) + " is not a line of an STL file");
      }
    }
    if (corners != 0) {
      throw InputError(description_.name + ": the file ends within a facet");
    }
  }

  void begin_solid(const std::string& name) {
    group_ = no_group;
    if (name.empty()) {
      return;
    }
    const auto next = static_cast<std::int32_t>(description_.groups.size());
    group_ = groups_.try_emplace(name, next).first->second;
    if (group_ == next) {
      description_.groups.push_back(name);
    }
  }

  Vec3 point_of(const TextLine& line, const std::string& place) {
    split_words(line.rest, words_, 4);
    std::array<double, 3> p{};
    if (words_.size() != 3) {
      throw InputError(place + "a vertex must have three coordinates");
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const std::optional<double> number = parse_number(words_[k]);
      if (!number) {
        throw InputError(place + in_quotes(words_[k]) + " is not a number");
      }
      p[k] = *number;
    }
    return {p[0], p[1], p[2]};
  }

  void add_triangle(const std::string& place, std::int32_t line) {
    std::array<PointId, 3> outline{};
    for (std::size_t k = 0; k < 3; ++k) {
      if (!is_finite(corner_[k]) || max_abs(corner_[k]) > largest_coordinate) {
        throw InputError(fmt::format("{}a vertex is not a finite point of at most {}", place,
                                     largest_coordinate));
      }
      outline[k] = points_.id_of(corner_[k]);
    }
    description_.add_face(outline, materials_->without_color(), line, group_);
  }

  const Cancellation& cancellation_;
  const std::string bytes_;
  SceneDescription description_;
  std::optional<FaceMaterials> materials_;
  PointTable points_;
  std::array<Vec3, 3> corner_;
  std::vector<std::string_view> words_;
  std::map<std::string, std::int32_t> groups_;
  std::int32_t group_ = no_group;
};

}  // namespace

SceneDescription read_stl(const std::filesystem::path& path, const ReadOptions& options,
                          const Cancellation& cancellation) {
  return StlReader(path, options, cancellation).read();
}

}  // namespace transillum
