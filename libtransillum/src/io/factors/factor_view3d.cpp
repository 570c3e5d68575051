// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The text form of the program View3D (NIST): a head of 30 characters, `View3D VERSION FORMAT
// ENCLOSURE EMITTANCES SURFACES`, a line with the areas, a line per row of the dense matrix, a line
// with the emittances.
#include <fmt/format.h>

#include "io/factors/factor_formats.h"
#include "io/text.h"
#include "transillum/errors.h"

namespace transillum {
namespace {

constexpr PatchId most_patches = 32768;  ///< the matrix is dense: 2 GB of zeros

}  // namespace

void write_factors_view3d(std::ostream& out, const Scene& scene, const FormFactors& form_factors) {
  if (scene.patch_count() > most_patches) {
    throw InputError(
        fmt::format("{} patches are too many for the dense matrix of a .vf file: at "
                    "most {}; write .npz or .mtx",
                    scene.patch_count(), most_patches));
  }
  if (!form_factors.moments.empty()) {
    throw InputError("a .vf file has no moments of linear functions; write .npz or .mtx");
  }
  TextBuffer text(out);
  text.add("{:<30}\n", fmt::format("View3D 3.2 0 0 0 {}", scene.patch_count()));
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    text.add("{}{}", i == 0 ? "" : " ", scene.patch(i).area);
  }
  text.add("\n");
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    const auto row = static_cast<std::size_t>(i);
    std::size_t k = form_factors.row_begin[row];
    for (PatchId j = 0; j < scene.patch_count(); ++j) {
      const bool present = k < form_factors.row_begin[row + 1] && form_factors.source[k] == j;
      text.add("{}{}", j == 0 ? "" : " ", present ? form_factors.value[k++] : 0.0);
    }
    text.add("\n");
  }
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    const Rgb& rho = scene.reflectance(i);
    text.add("{}{}", i == 0 ? "" : " ", 1 - (rho.r + rho.g + rho.b) / 3);
  }
  text.add("\n");
}

}  // namespace transillum
