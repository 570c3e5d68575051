// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "help_format.h"

#include <sstream>

namespace transillum::cli {
namespace {

constexpr std::size_t page_width = 96;
constexpr std::size_t name_width = 26;

}  // namespace

HelpFormat::HelpFormat() { column_width(name_width); }

/// Without the lists of excluded options: descriptions and error messages contain them.
std::string HelpFormat::make_option_opts(const CLI::Option* option) const {
  return option->get_type_name().empty() ? std::string() : " " + option->get_type_name();
}

std::string HelpFormat::make_option_desc(const CLI::Option* option) const {
  return wrapped(option->get_description(), page_width - name_width);
}

std::string wrapped(const std::string& text, std::size_t width) {
  std::istringstream words(text);
  std::string word, result;
  std::size_t column = 0;
  while (words >> word) {
    const bool fits = column + 1 + word.size() <= width;
    if (!result.empty()) {
      result += fits ? ' ' : '\n';
    }
    column = fits && !result.empty() ? column + 1 + word.size() : word.size();
    result += word;
  }
  return result;
}

}  // namespace transillum::cli
