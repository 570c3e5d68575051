// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Builds a scene from arrays of points and faces, as a program with its own geometry does, and
// solves it: a closed cube whose ceiling is a light.
//
// Usage: scene_from_arrays
#include <transillum/transillum.h>

#include <array>
#include <cstdio>
#include <memory>

int main() {
  try {
    transillum::SceneDescription cube;
    cube.name = "cube";
    cube.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                   {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
    cube.materials = {{"gray", {0.5, 0.5, 0.5}, {0, 0, 0}}, {"light", {0, 0, 0}, {10, 10, 10}}};
    // Counter-clockwise seen from the side that emits and receives: here from inside.
    const std::array<std::array<transillum::PointId, 4>, 6> faces{{
        {0, 1, 2, 3},  // floor
        {4, 7, 6, 5},  // ceiling
        {0, 4, 5, 1},
        {1, 5, 6, 2},
        {2, 6, 7, 3},
        {3, 7, 4, 0},
    }};
    for (std::size_t f = 0; f < faces.size(); ++f) {
      cube.add_face(faces[f], f == 1 ? 1 : 0);
    }
    const auto scene = std::make_shared<const transillum::Scene>(cube);

    transillum::SolveOptions options;
    options.normalize = transillum::Normalization::symmetric;
    const transillum::Solution solution = transillum::solve(scene, options);

    // Patches have the numbers of their faces: no option cuts a face into several.
    for (transillum::PatchId i = 0; i < scene->patch_count(); ++i) {
      std::printf("face %d: B = %.3f W/m2\n", scene->patch(i).face,
                  transillum::at(solution.radiosity, i).g);
    }
    std::printf("energy balance %.6f\n", solution.statistics.energy_balance);
    return 0;
  } catch (const transillum::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
