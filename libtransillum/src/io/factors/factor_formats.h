// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <iosfwd>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/content_hash.h"
#include "transillum/files.h"

namespace transillum {

// One pair of functions per format of write_form_factors() and read_form_factors(). Readers get the
// bytes of the file and its name, and throw InputError.

/// Largest file of form factors that is read, in bytes.
inline constexpr std::uintmax_t largest_factor_file = std::uintmax_t{1} << 36;

void write_factors_npz(std::ostream& out, const Scene& scene, const FormFactors& form_factors);
StoredFormFactors read_factors_npz(const std::string& name, std::string_view bytes,
                                   const Cancellation& cancellation);

void write_factors_mtx(std::ostream& out, const Scene& scene, const FormFactors& form_factors);
StoredFormFactors read_factors_mtx(const std::string& name, std::string_view text,
                                   const Cancellation& cancellation);

/// @throws InputError where a dense matrix would be too large
void write_factors_view3d(std::ostream& out, const Scene& scene, const FormFactors& form_factors);

/// The hash by which a file identifies the polygons of its scene.
std::string hash_of_polygons(const Scene& scene,
                             ContentHash::Method method = ContentHash::Method::xxh3);

/// An entry of a matrix in any order.
struct FactorEntry {
  PatchId i, j;
  double value;
};
/// Adds moments to the matrix of `entries`.
/// @param values T^ab / A_i at 9 k + 3 a + b, k being an index of `entries`
/// @throws InputError where their number differs, one is not finite, or `entries` are not in the
/// order of the matrix
void add_moments(const std::string& name, std::span<const double> values,
                 const std::vector<FactorEntry>& entries, FormFactors& form_factors);

/// The matrix of the entries: sorted, entries of one place added up, zeros omitted.
/// @throws InputError where a value is not finite or less than 0
/// @throws Canceled
FormFactors sorted_factors(const std::string& name, PatchId patches,
                           const std::vector<FactorEntry>& entries,
                           const Cancellation& cancellation);

}  // namespace transillum
