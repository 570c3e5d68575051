// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <zlib.h>

#include <string>

namespace transillum::testing {

/// The content of a stream of a PDF file, at most 1 MB; empty where it is not compressed.
inline std::string decompressed(const std::string& stream) {
  std::string text(1U << 20, '\0');
  uLongf size = text.size();
  const int status = uncompress(reinterpret_cast<Bytef*>(text.data()), &size,
                                reinterpret_cast<const Bytef*>(stream.data()), stream.size());
  text.resize(status == Z_OK ? size : 0);
  return text;
}

/// The operators of the page of a PDF file by Cairo, whose first stream it is.
inline std::string page_of(const std::string& pdf) {
  const std::string begin_word = "stream\n";
  const std::size_t begin = pdf.find(begin_word) + begin_word.size();
  return decompressed(pdf.substr(begin, pdf.find("\nendstream", begin) - begin));
}

}  // namespace transillum::testing
