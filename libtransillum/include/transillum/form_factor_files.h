// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Form factors as files of other programs, and back. Formats: data/FILES.md.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "transillum/cancellation.h"
#include "transillum/export.h"
#include "transillum/form_factors.h"
#include "transillum/scene.h"

namespace TRANSILLUM_API transillum {

/// Form factors read from a file.
struct StoredFormFactors {
  std::string name;           ///< name of the file, for error messages
  FormFactors form_factors;   ///< rows sorted by source, values > 0
  std::vector<double> areas;  ///< areas of the patches, m²; empty if the file has none
  std::string polygons;       ///< hash of the corners of all patches; empty: the file has none
};

/// Checks that `path` is writable and ends in .csv, .npz, .mtx or .vf, or has no ending, which
/// means .csv.
/// @throws InputError
void check_form_factor_path(const std::filesystem::path& path);
/// Writes form factors in the format given by the extension of `path`: .csv (i,j,F), .npz (a
/// compressed sparse row matrix as scipy.sparse.load_npz() reads it), .mtx (Matrix Market), .vf
/// (the text form of View3D: a dense matrix). All but .vf also have FormFactors::moments, if any.
/// @param path the file.
/// @param scene whose areas .npz, .mtx and .vf files hold, whose polygons' hash .npz and .mtx
/// files, and whose reflectances .vf files.
/// @param form_factors of `scene`.
/// @throws InputError for another extension, where the matrix is too large for the format, or for
/// moments in a .vf file
/// @throws std::runtime_error if the file cannot be written.
void write_form_factors(const std::filesystem::path& path, const Scene& scene,
                        const FormFactors& form_factors);

/// Whether `path` ends in .npz or .mtx.
bool is_form_factor_file(const std::filesystem::path& path);
/// Reads form factors from a .npz or .mtx file, by write_form_factors() or another program.
/// @throws InputError naming the file and what is wrong with it
/// @throws Canceled
StoredFormFactors read_form_factors(const std::filesystem::path& path,
                                    const Cancellation& cancellation = {});
/// Checks that form factors belong to a scene: the number of patches; their areas, to 1e-9; in
/// files without areas, that A_i F_ij and A_j F_ji differ by at most 10 % on average; the hash of
/// the polygons, without which an object that has moved is not noticed.
/// @throws InputError naming the file and the difference.
void check_form_factors(const Scene& scene, const StoredFormFactors& stored);

}  // namespace TRANSILLUM_API transillum
