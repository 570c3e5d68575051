// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <string>

namespace transillum {

/// `text` as valid UTF-8: invalid bytes become U+FFFD, control characters become blanks. For names
/// of files, scenes and materials, which may contain any bytes.
std::string clean_text(const std::string& text);

/// clean_text() with &, <, > and " escaped, for XML content and attributes.
std::string xml_text(const std::string& text);

}  // namespace transillum
