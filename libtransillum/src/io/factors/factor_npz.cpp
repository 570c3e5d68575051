// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Form factors as SciPy's compressed sparse rows (scipy.sparse.save_npz): a ZIP archive of the
// arrays indices, indptr, format, shape and data. `area`, `polygons` and `moments` are added; SciPy
// does not mind.
#include <fmt/format.h>

#include <limits>
#include <span>

#include "base/text_file.h"
#include "io/factors/factor_formats.h"
#include "io/factors/npy_array.h"
#include "io/factors/zip_archive.h"
#include "transillum/errors.h"

namespace transillum {
namespace {

template <class Number>
void add_array(ZipWriter& zip, const char* name, const char* type, std::span<const Number> values) {
  zip.add(fmt::format("{}.npy", name), npy_head(type, fmt::format("({},)", values.size())),
          {reinterpret_cast<const char*>(values.data()), values.size_bytes()});
}

/// Reads the arrays of one file.
class NpzReader {
 public:
  NpzReader(const std::string& name, std::string_view bytes) : name_(name), zip_(name, bytes) {}

  bool has(const char* array) const { return zip_.has(fmt::format("{}.npy", array)); }
  NpyArray array(const char* array) const {
    return {fmt::format("{}: {}", name_, array), zip_.read(fmt::format("{}.npy", array))};
  }
  [[noreturn]] void refuse(const std::string& what) const { throw InputError(name_ + ": " + what); }

  PatchId patches() const {
    if (const std::string format = array("format").text(); format != "csr") {
      refuse(fmt::format("a matrix of format {}; compressed sparse rows (csr) are read",
                         in_quotes(format)));
    }
    const std::vector<std::int64_t> shape = array("shape").whole_numbers();
    constexpr std::int64_t most = std::numeric_limits<PatchId>::max() - 1;
    if (shape.size() != 2 || shape[0] != shape[1] || shape[0] < 1 || shape[0] > most) {
      refuse("the matrix is not square");
    }
    return static_cast<PatchId>(shape[0]);
  }

 private:
  const std::string& name_;
  ZipReader zip_;
};

}  // namespace

void write_factors_npz(std::ostream& out, const Scene& scene, const FormFactors& form_factors) {
  if (form_factors.size() > std::numeric_limits<std::int32_t>::max()) {
    throw InputError("the form factors are too many for a .npz file; write .mtx");
  }
  std::vector<std::int32_t> begin;
  for (const std::size_t k : form_factors.row_begin) {
    begin.push_back(static_cast<std::int32_t>(k));
  }
  const std::int64_t shape[] = {scene.patch_count(), scene.patch_count()};
  std::vector<double> areas;
  for (const Patch& patch : scene.patches()) {
    areas.push_back(patch.area);
  }
  ZipWriter zip(out);
  add_array<std::int32_t>(zip, "indices", "<i4", form_factors.source);
  add_array<std::int32_t>(zip, "indptr", "<i4", begin);
  zip.add("format.npy", npy_head("|S3", "()"), "csr");
  add_array<std::int64_t>(zip, "shape", "<i8", shape);
  add_array<double>(zip, "data", "<f8", form_factors.value);
  add_array<double>(zip, "area", "<f8", areas);
  const std::string polygons = hash_of_polygons(scene);
  zip.add("polygons.npy", npy_head(fmt::format("|S{}", polygons.size()), "()"), polygons);
  if (!form_factors.moments.empty()) {
    std::vector<double> moments;
    for (const TransferMoments& of_pair : form_factors.moments) {
      moments.insert(moments.end(), of_pair.value.begin(), of_pair.value.end());
    }
    add_array<double>(zip, "moments", "<f8", moments);
  }
  zip.finish();
}

StoredFormFactors read_factors_npz(const std::string& name, std::string_view bytes,
                                   const Cancellation& cancellation) {
  const NpzReader file(name, bytes);
  const PatchId patches = file.patches();
  const std::vector<std::int64_t> begin = file.array("indptr").whole_numbers();
  const std::vector<std::int64_t> source = file.array("indices").whole_numbers();
  const std::vector<double> value = file.array("data").numbers();
  const auto entries = static_cast<std::int64_t>(value.size());
  if (begin.size() != static_cast<std::size_t>(patches) + 1 || begin.front() != 0 ||
      begin.back() != entries || source.size() != value.size()) {
    file.refuse("the lengths of indptr, indices and data do not fit the matrix");
  }
  std::vector<FactorEntry> list;
  list.reserve(value.size());
  for (PatchId i = 0; i < patches; ++i) {
    cancellation.throw_if_canceled();
    const auto row = static_cast<std::size_t>(i);
    if (begin[row] > begin[row + 1] || begin[row + 1] > entries) {
      file.refuse(
          fmt::format("row {} ends at {}, before it begins at {}", i, begin[row + 1], begin[row]));
    }
    for (auto k = static_cast<std::size_t>(begin[row]);
         k < static_cast<std::size_t>(begin[row + 1]); ++k) {
      if (source[k] < 0 || source[k] >= patches) {
        file.refuse(fmt::format("row {} has column {}, which is not in the range 0 to {}", i,
                                source[k], patches - 1));
      }
      list.push_back({i, static_cast<PatchId>(source[k]), value[k]});
    }
  }
  StoredFormFactors stored{name, sorted_factors(name, patches, list, cancellation), {}, {}};
  if (file.has("moments")) {
    add_moments(name, file.array("moments").numbers(), list, stored.form_factors);
  }
  if (file.has("area")) {
    stored.areas = file.array("area").numbers();
  }
  if (file.has("polygons")) {
    stored.polygons = file.array("polygons").text();
  }
  return stored;
}

}  // namespace transillum
