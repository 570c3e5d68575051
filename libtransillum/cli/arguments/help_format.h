// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <string>
#include <vector>

namespace transillum::cli {

/// Formats CLI11's help, wrapped to the page width. --help shows the group Options alone,
/// --help-all all groups.
class HelpFormat : public CLI::Formatter {
 public:
  HelpFormat();
  std::string make_help(const CLI::App* app, std::string name,
                        CLI::AppFormatMode mode) const override;
  std::string make_group(std::string group, bool is_positional,
                         std::vector<const CLI::Option*> options) const override;
  std::string make_option_opts(const CLI::Option* option) const override;
  std::string make_option_desc(const CLI::Option* option) const override;

 private:
  mutable std::size_t hidden_ = 0;  ///< options that the present help does not show
};

/// `text` broken into lines of at most `width` characters.
std::string wrapped(const std::string& text, std::size_t width);

}  // namespace transillum::cli
