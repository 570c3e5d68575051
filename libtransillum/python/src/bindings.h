// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "transillum/solve_options.h"

// Parts of the module `transillum._core`.
namespace transillum::python {

void bind_scene(pybind11::module_& module);
void bind_solve(pybind11::module_& module);
void bind_visibility(pybind11::module_& module);

/// Whether options without directions and an accuracy mean the default accuracy.
enum class Goal { none, by_default };

/// Options of a solve from keywords: the names in the table of options, with underscores.
/// @throws InputError for a name or value that does not exist, or that would have no effect
/// @param goal whether there is a default accuracy
SolveOptions options_from(const pybind11::dict& keywords, Goal goal = Goal::by_default);

/// @throws InputError where a keyword is one of `names`, or, unless `listed`, where it is none
void refuse(const pybind11::dict& keywords, const std::vector<std::string>& names, bool listed,
            const std::string& function);

/// Keyword, type, description and default of every option of a solve.
pybind11::list option_list();

}  // namespace transillum::python
