// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <string>

namespace transillum {

/// Valid UTF-8 without control characters: names of files and materials may be anything.
std::string clean_text(const std::string& text);

/// The same, for between tags or quotes of XML.
std::string xml_text(const std::string& text);

}  // namespace transillum
