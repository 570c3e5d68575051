// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Solves a scene once, then changes its materials and solves again without a single pass: form
// factors depend on the geometry only.
//
// Usage: relight SCENE FACTOR
//   SCENE   a .obj file or a built-in scene, such as "furnace"
//   FACTOR  every reflectance is multiplied by it, >= 0; the result must be below 1
// A furnace (E = 1, rho = 0.5) with FACTOR 1.5 has rho = 0.75 and B = 1 / (1 - 0.75) = 4.
#include <transillum/transillum.h>

#include <cstdio>
#include <cstdlib>
#include <vector>

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: %s SCENE FACTOR\n", argv[0]);
    return 2;
  }
  try {
    const auto scene = transillum::load_scene(argv[1]);
    transillum::SolveOptions options;
    options.directions = 256;
    options.normalize = transillum::Normalization::rows;
    transillum::RadiositySolver solver(scene, options);
    solver.advance(transillum::RadiositySolver::Until::finished);

    std::vector<transillum::Material> materials = scene->materials();
    for (transillum::Material& material : materials) {
      material.reflectance = std::atof(argv[2]) * material.reflectance;
    }
    const transillum::RelightResult relit = transillum::relight(
        *scene, solver.form_factors(), materials, {.start = solver.radiosity()});

    std::printf("B of patch 0: %.4f before, %.4f after %d more iterations\n",
                solver.radiosity().front().g, relit.radiosity.front().g, relit.iterations);
    return 0;
  } catch (const transillum::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
