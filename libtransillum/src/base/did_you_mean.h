// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <string>
#include <vector>


namespace transillum {

/// The entry of `names` closest to `word` by edit distance, or an empty string if none is within
/// a third of the length of `word` (at least one edit). A word longer than 64 characters matches
/// nothing.
std::string nearest_name(const std::string& word, const std::vector<std::string>& names);

/// The end of an error message about an unknown name: `; did you mean "x"?`, or an empty string if
/// nearest_name() finds none.
std::string did_you_mean(const std::string& word, const std::vector<std::string>& names);

}  // namespace transillum
