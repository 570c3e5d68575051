// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Solves a scene and writes the radiosity of every patch.
//
// Usage: solve_file SCENE RESULT
//   SCENE   a .obj file or a built-in scene, such as "furnace" or "rooms:size=4"
//   RESULT  a .csv, .vtp, .ply or .obj file
// In a furnace (E = 1, rho = 0.5 everywhere) every patch has B = 2.
#include <transillum/transillum.h>

#include <cstdio>

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: %s SCENE RESULT\n", argv[0]);
    return 2;
  }
  try {
    transillum::check_result_path(argv[2]);
    const auto scene = transillum::load_scene(argv[1]);

    transillum::SolveOptions options;
    options.directions = 256;
    options.normalize = transillum::Normalization::rows;
    const transillum::Solution solution = transillum::solve(scene, options);

    transillum::Bounds brightest;  // range of B over all patches, channel by channel
    for (const transillum::Rgb& b : solution.radiosity) {
      brightest.add({b.r, b.g, b.b});
    }
    transillum::write_result(argv[2], solution);
    std::printf("%d patches, B from (%.4f, %.4f, %.4f) to (%.4f, %.4f, %.4f) W/m2\n",
                scene->patch_count(), brightest.low.x, brightest.low.y, brightest.low.z,
                brightest.high.x, brightest.high.y, brightest.high.z);
    return 0;
  } catch (const transillum::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
