// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <CLI/CLI.hpp>

namespace transillum::cli {

/// Formats CLI11's help, wrapped to the page width.
class HelpFormat : public CLI::Formatter {
 public:
  HelpFormat();
  std::string make_option_opts(const CLI::Option* option) const override;
  std::string make_option_desc(const CLI::Option* option) const override;
};

/// `text` broken into lines of at most `width` characters.
std::string wrapped(const std::string& text, std::size_t width);

}  // namespace transillum::cli
