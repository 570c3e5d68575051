// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <fmt/format.h>

#include <ostream>

#include "base/text_file.h"
#include "io/pictures/picture_writers.h"
#include "transillum/errors.h"
#include "transillum/files.h"
#include "transillum/picture.h"

namespace transillum {

bool is_picture_file(const std::filesystem::path& path) {
  const std::string ending = lower_case_ending(path);
  return ending == ".png" || ending == ".exr" || ending == ".pfm";
}

bool is_screen_picture(const std::filesystem::path& path) {
  return lower_case_ending(path) == ".png";
}

void check_picture_path(const std::filesystem::path& path) {
  if (!is_picture_file(path)) {
    throw InputError(
        fmt::format("{}: the name of a picture must end in .png, .exr or .pfm", path.string()));
  }
  check_writable(path);
}

void check_pixels(const Picture& picture) {
  const bool has_size = picture.width > 0 && picture.height > 0;
  if (!has_size || picture.radiance.size() != static_cast<std::size_t>(picture.width) *
                                                  static_cast<std::size_t>(picture.height)) {
    throw InputError(fmt::format("picture: {} colors for {} by {} pixels", picture.radiance.size(),
                                 picture.width, picture.height));
  }
  if (!picture.coverage.empty() && picture.coverage.size() != picture.radiance.size()) {
    throw InputError(fmt::format("picture: coverage of {} pixels for {} by {} pixels",
                                 picture.coverage.size(), picture.width, picture.height));
  }
}

void write_picture(const std::filesystem::path& path, const Picture& picture,
                   const PictureLook& look) {
  check_picture_path(path);
  check_pixels(picture);
  look.validate();
  write_file_whole(path, [&](std::ostream& out) {
    if (is_screen_picture(path)) {
      write_picture_png(out, picture, look);
    } else if (lower_case_ending(path) == ".exr") {
      write_picture_exr(out, picture);
    } else {
      write_picture_pfm(out, picture);
    }
  });
}

}  // namespace transillum
