// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "scene/read/scene_readers.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <optional>

#include "base/text_file.h"
#include "scene/build/description_check.h"
#include "scene/build/warnings.h"
#include "scene/read/face_materials.h"
#include "scene/read/texture_average.h"
#include "transillum/errors.h"

namespace transillum {
namespace {

class OffReader {
 public:
  OffReader(const std::filesystem::path& path, const ReadOptions& options,
            const Cancellation& cancellation)
      : text_(read_text_file(path, largest_scene_file)), lines_(text_, cancellation) {
    description_.name = path.string();
    description_.files = {path.string()};
    materials_.emplace(description_, options);
  }

  SceneDescription read() {
    read_header();
    for (std::size_t v = 0; v < vertices_; ++v) {
      read_vertex(v);
    }
    for (std::size_t f = 0; f < faces_; ++f) {
      read_face(f);
    }
    if (faces_ == 0) {
      fail("has no faces");
    }
    materials_->note(notes_, "");
    description_.notes = notes_.sentences();
    return std::move(description_);
  }

 private:
  /// The words of the next line, the first `most` of them.
  void next_line(const std::string& expected, std::size_t most = std::string_view::npos) {
    const std::optional<TextLine> line = lines_.next();
    if (!line) {
      fail("the file ends before " + expected);
    }
    line_ = line->number;
    split_words(line->rest, words_, most);
    words_.insert(words_.begin(), line->keyword);
  }

  void read_header() {
    next_line("its first line");
    // Letters before OFF: texture coordinates, colors and normals, after the coordinates. The first
    // count may follow without a blank.
    const std::string_view name = words_.front();
    const std::size_t letters = name.find("OFF");
    if (letters != std::string_view::npos) {
      if (name.substr(0, letters).find_first_not_of("STCN") != std::string_view::npos) {
        fail(in_quotes(name) + ": points with other than three coordinates cannot be read");
      }
      words_.front().remove_prefix(letters + 3);
      if (words_.front().empty()) {
        words_.erase(words_.begin());
      }
      if (!words_.empty() && words_.front() == "BINARY") {
        fail("is a binary OFF file; only ASCII can be read");
      }
      if (words_.empty()) {
        next_line("the numbers of vertices and faces");
      }
    }
    if (words_.size() < 2) {
      fail("is not an OFF file: the numbers of vertices and faces are missing");
    }
    vertices_ = count(words_[0]);
    faces_ = count(words_[1]);
  }

  /// A number of lines that the file has room for.
  std::size_t count(std::string_view word) const {
    std::size_t number = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error != std::errc() || end != word.data() + word.size() || number > text_.size()) {
      fail(fmt::format("{} is not a number of lines in a file of {} bytes", in_quotes(word),
                       text_.size()));
    }
    return number;
  }

  double number(std::string_view word) const {
    const std::optional<double> value = parse_number(word);
    if (!value) {
      fail(in_quotes(word) + " is not a number");
    }
    return *value;
  }

  void read_vertex(std::size_t v) {
    next_line(fmt::format("vertex {} of {}", v, vertices_), 3);
    if (words_.size() < 3) {
      fail(fmt::format("vertex {}: three coordinates are required", v));
    }
    const Vec3 p{number(words_[0]), number(words_[1]), number(words_[2])};
    if (!is_finite(p) || max_abs(p) > largest_coordinate) {
      fail(fmt::format("vertex {} is not a finite point of at most {}", v, largest_coordinate));
    }
    description_.points.push_back(p);
  }

  void read_face(std::size_t f) {
    next_line(fmt::format("face {} of {}", f, faces_));
    const std::size_t corners = count(words_[0]);
    if (corners >= words_.size()) {
      fail(fmt::format("face {} has {} corners, of {} that it states", f, words_.size() - 1,
                       corners));
    }
    outline_.clear();
    for (std::size_t k = 1; k <= corners; ++k) {
      PointId index = -1;
      const std::string_view word = words_[k];
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), index);
      if (error != std::errc() || end != word.data() + word.size() || index < 0 ||
          static_cast<std::size_t>(index) >= vertices_) {
        fail(fmt::format("face {}: vertex {} does not exist; there are {}", f, in_quotes(word),
                         vertices_));
      }
      outline_.push_back(index);
    }
    const std::size_t first = corners + 1;
    const std::int32_t material =
        words_.size() >= first + 3 ? material_at(first) : materials_->without_color();
    description_.add_face(outline_, material, line_);
  }

  /// The material of a color, whose first word this is.
  std::int32_t material_at(std::size_t first) {
    std::array<double, 3> c{};
    bool whole = true;
    for (std::size_t k = 0; k < 3; ++k) {
      c[k] = number(words_[first + k]);
      whole = whole && words_[first + k].find_first_of(".eE") == std::string_view::npos;
      if (!(c[k] >= 0 && c[k] <= 255)) {
        fail(fmt::format("color {} is not in the range 0 to 255", c[k]));
      }
    }
    if (!whole) {
      return materials_->of_numbers({c[0], c[1], c[2]}, {},
                                    fmt::format("{}:{}: ", description_.name, line_), notes_);
    }
    return materials_->of_color({linear_of_srgb(static_cast<std::uint8_t>(c[0])),
                                 linear_of_srgb(static_cast<std::uint8_t>(c[1])),
                                 linear_of_srgb(static_cast<std::uint8_t>(c[2]))});
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("{}:{}: {}", description_.name, line_, what));
  }

  const std::string text_;
  LineReader lines_;
  SceneDescription description_;
  std::optional<FaceMaterials> materials_;
  Warnings notes_;
  std::size_t vertices_ = 0, faces_ = 0;
  std::int32_t line_ = 0;
  std::vector<std::string_view> words_;
  std::vector<PointId> outline_;
};

}  // namespace

SceneDescription read_off(const std::filesystem::path& path, const ReadOptions& options,
                          const Cancellation& cancellation) {
  return OffReader(path, options, cancellation).read();
}

}  // namespace transillum
