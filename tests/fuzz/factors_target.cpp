// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// Fuzz target: the readers of form factors. An input is read as a .npz archive, as a .mtx text, and
// as the arrays of an archive, separated by lines `%npy`, which get valid sizes and CRCs here: no
// mutation would find these.
#include <cmath>
#include <cstdint>
#include <sstream>
#include <string>
#include <string_view>

#include "fuzz/require.h"
#include "io/factors/factor_formats.h"
#include "io/factors/zip_archive.h"
#include "transillum/errors.h"

namespace transillum::fuzz {
namespace {

constexpr std::string_view separator = "\n%npy\n";

void check(const StoredFormFactors& stored) {
  const FormFactors& f = stored.form_factors;
  require(f.row_begin.size() >= 2 && f.row_begin.front() == 0, "a matrix has rows");
  require(f.row_begin.back() == f.size() && f.source.size() == f.size(), "lists fit the rows");
  const auto patches = static_cast<PatchId>(f.row_begin.size() - 1);
  for (std::size_t i = 0; i + 1 < f.row_begin.size(); ++i) {
    require(f.row_begin[i] <= f.row_begin[i + 1], "rows follow each other");
    for (std::size_t k = f.row_begin[i]; k < f.row_begin[i + 1]; ++k) {
      require(f.source[k] >= 0 && f.source[k] < patches, "a source is a patch");
      require(k == f.row_begin[i] || f.source[k - 1] < f.source[k], "rows are sorted");
      require(f.value[k] > 0 && std::isfinite(f.value[k]), "values are positive");
    }
  }
}

/// Calls `read`, whose only exception may be an InputError with one line that names the file.
template <class Read>
void check_reader(const Read& read) {
  try {
    check(read());
  } catch (const InputError& error) {
    const std::string_view text = error.what();
    constexpr std::size_t longest_message = 400;
    require(text.starts_with("f."), "an error begins with the file");
    require(text.find('\n') == std::string_view::npos, "an error is one line");
    require(text.size() <= longest_message, "an error is short");
  }
}

/// The archive whose arrays are the parts of the input.
std::string archive_of(std::string_view input) {
  std::ostringstream out;
  ZipWriter zip(out);
  for (const char* name : {"format", "shape", "indptr", "indices", "data", "area"}) {
    const std::size_t end = std::min(input.find(separator), input.size());
    zip.add(std::string(name) + ".npy", input.substr(0, end), {});
    input.remove_prefix(std::min(end + separator.size(), input.size()));
  }
  zip.finish();
  return out.str();
}

}  // namespace
}  // namespace transillum::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace transillum;
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  fuzz::check_reader([&] { return read_factors_npz("f.npz", input, {}); });
  fuzz::check_reader([&] { return read_factors_mtx("f.mtx", input, {}); });
  const std::string archive = fuzz::archive_of(input);
  fuzz::check_reader([&] { return read_factors_npz("f.npz", archive, {}); });
  return 0;
}
