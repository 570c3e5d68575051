// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <string>
#include <vector>

#include "command_model.h"

namespace transillum::manual {

/// Texts that the pages of a program contain besides its options.
struct Introduction {
  std::string version;
  std::string date;                     ///< such as 2026-11-23
  std::vector<std::string> paragraphs;  ///< text of DESCRIPTION
  std::vector<std::string> see_also;    ///< names of pages of section 1
};

/// A page of section 1 in the macros of man(7).
struct ManPage {
  std::string name;  ///< such as transillum-solve
  std::string text;
};

/// One page of a program, and one of each command.
std::vector<ManPage> man_pages(const Program& program, const Introduction& introduction);
/// The page alone; of a program that has the commands of another.
ManPage page_of_program(const Program& program, const Introduction& introduction);

}  // namespace transillum::manual
