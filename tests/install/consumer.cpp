// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <transillum/transillum.h>

#include <cmath>
#include <cstdio>

/// In a furnace, E = 1 and rho = 0.5 everywhere give B = 2 (ALGORITHM.md, oracle 3).
int main() {
  transillum::SolveOptions options;
  options.directions = 32;
  options.normalize = transillum::Normalization::rows;
  options.tolerance = 1e-12;
  const auto solution = transillum::solve(transillum::load_scene("furnace"), options);
  if (!solution.complete || solution.radiosity.empty()) {
    return 1;
  }
  for (const transillum::Rgb& b : solution.radiosity) {
    if (std::abs(b.r - 2) > 1e-9) {
      std::printf("B is %.17g, not 2\n", b.r);
      return 1;
    }
  }
  std::printf("B is 2 on %zu patches\n", solution.radiosity.size());
  return 0;
}
