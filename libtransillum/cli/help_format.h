// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <CLI/CLI.hpp>

namespace transillum::cli {

/// CLI11's help, wrapped to the width of a page.
class HelpFormat : public CLI::Formatter {
 public:
  HelpFormat();
  std::string make_option_opts(const CLI::Option* option) const override;
  std::string make_option_desc(const CLI::Option* option) const override;
};

/// The words of `text` in lines of at most `width`.
std::string wrapped(const std::string& text, std::size_t width);

}  // namespace transillum::cli
