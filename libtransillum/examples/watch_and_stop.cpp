// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Solves direction by direction, prints the change made by each pass, and stops when 20 passes in
// a row have changed the estimate by less than a given fraction.
//
// Usage: watch_and_stop SCENE [SHARE]
//   SCENE  a .obj file or a built-in scene, such as "cornell-box"
//   SHARE  largest change of B over the largest reflected light; default 0.001
#include <transillum/transillum.h>

#include <cstdio>
#include <cstdlib>
#include <vector>

int main(int argc, char** argv) {
  if (argc < 2 || argc > 3) {
    std::fprintf(stderr, "usage: %s SCENE [SHARE]\n", argv[0]);
    return 2;
  }
  const double enough = argc == 3 ? std::atof(argv[2]) : 0.001;
  try {
    transillum::SolveOptions options;
    options.directions = 1024;
    transillum::RadiositySolver solver(transillum::load_scene(argv[1]), options);

    int quiet = 0;  // passes in a row with a small change
    using Until = transillum::RadiositySolver::Until;
    while (quiet < 20 && solver.advance(Until::direction)) {
      const auto& changes = solver.estimate_changes();  // by the passes of this iteration
      if (changes.empty()) {
        break;  // the first iteration is finished
      }
      quiet = changes.back() < enough ? quiet + 1 : 0;
      const transillum::Vec3 omega = solver.progress().last_direction;
      std::printf("pass %4zu, direction (%6.3f, %6.3f, %6.3f): B changes by %.4f\n", changes.size(),
                  omega.x, omega.y, omega.z, changes.back());
    }
    double power = 0;
    const std::vector<transillum::Rgb> b = solver.running_estimate();
    for (transillum::PatchId i = 0; i < solver.scene().patch_count(); ++i) {
      power += solver.scene().patch(i).area * transillum::at(b, i).g;
    }
    std::printf(
        "stopped after %d of %d passes; all patches emit and reflect %.4f W of green light\n",
        solver.progress().direction, options.directions, power);
    return 0;
  } catch (const transillum::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
