// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "cli/arguments/help_format.h"

#include <sstream>
#include <string>
#include <utility>

namespace transillum::cli {
namespace {

constexpr std::size_t page_width = 96;
constexpr std::size_t name_width = 26;
constexpr const char* common_section = "Options";

}  // namespace

HelpFormat::HelpFormat() { column_width(name_width); }

std::string HelpFormat::make_help(const CLI::App* app, std::string name,
                                  CLI::AppFormatMode mode) const {
  const bool shows_all = app->get_help_all_ptr() == nullptr || mode != CLI::AppFormatMode::Normal;
  hidden_ = shows_all
                ? 0
                : app->get_options([](const CLI::Option* option) {
                       return !option->get_positional() && option->get_group() != common_section;
                     })
                      .size();
  std::string text = Formatter::make_help(app, std::move(name), mode);
  // Hidden groups leave their empty lines.
  for (std::size_t at = 0; (at = text.find("\n\n\n", at)) != std::string::npos;) {
    text.erase(at, 1);
  }
  return text;
}

std::string HelpFormat::make_group(std::string group, bool is_positional,
                                   std::vector<const CLI::Option*> options) const {
  if (hidden_ > 0 && !is_positional && group != common_section) {
    return {};
  }
  const bool is_common = group == common_section;
  std::string text = Formatter::make_group(std::move(group), is_positional, std::move(options));
  return hidden_ > 0 && is_common
             ? text + "\n--help-all shows " + std::to_string(hidden_) + " more options.\n"
             : text;
}

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
