// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Draws what a patch of a scene, or an observer below it, sees along one direction.
//
// Usage: map_as_svg SCENE X Y Z FILE.svg [PATCH]
//   SCENE  a .obj file or a built-in scene, such as "sphere-flake"
//   X Y Z  the direction omega, of any length but 0: from the observer toward what is seen
//   PATCH  number of the observing patch; without it, the map seen from below the scene
#include <transillum/transillum.h>

#include <cstdio>
#include <cstdlib>

int main(int argc, char** argv) {
  if (argc < 6 || argc > 7) {
    std::fprintf(stderr, "usage: %s SCENE X Y Z FILE.svg [PATCH]\n", argv[0]);
    return 2;
  }
  try {
    transillum::check_map_path(argv[5]);
    const auto scene = transillum::load_scene(argv[1]);
    const transillum::Vec3 along{std::atof(argv[2]), std::atof(argv[3]), std::atof(argv[4])};
    const transillum::PatchId receiver = argc == 7 ? std::atoi(argv[6]) : transillum::no_patch;
    if (!(norm(along) > 0) || receiver >= scene->patch_count()) {
      throw transillum::InputError("the direction must not be 0, and the patch must exist");
    }

    const transillum::BspTree tree(*scene);
    const transillum::RecordedDirection direction =
        transillum::record_local_map(*scene, tree, normalized(along));
    const transillum::VisibilityMap map = receiver < 0
                                              ? transillum::map_from_below(direction)
                                              : transillum::map_of_receiver(direction, receiver);
    transillum::write_map(argv[5], *scene, map);
    std::printf("%zu polygons, %zu exchanges, closure defect %.1e\n", map.polygons.size(),
                map.exchanges.size(),
                transillum::closure_defect(direction.transfers, *scene).relative);
    return 0;
  } catch (const transillum::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
