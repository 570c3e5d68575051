// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include "test_files.h"

namespace transillum::viewer::test {

/// Writes FOLDER/open.obj: an open scene with the groups floor, lamp (which emits) and wall, and a
/// face in no group. The lamp's rho is 0. z is up.
inline QString write_open_scene(const QString& folder) {
  write_file(folder + "/open.mtl",
             "newmtl white\nKd .7 .7 .7\nnewmtl red\nKd .6 .2 .1\n"
             "newmtl glow\nKd 0 0 0\nKe 9 8 7\n");
  return write_file(folder + "/open.obj",
                    "mtllib open.mtl\n"
                    "v 4 0 0\nv 4 4 0\nv 4 4 2\nv 4 0 2\nusemtl red\nf 4 3 2 1\n"
                    "g floor\nv 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nusemtl white\nf 5 6 7 8\n"
                    "g lamp\nv 1 1 3\nv 2 1 3\nv 2 2 3\nv 1 2 3\nusemtl glow\nf 12 11 10 9\n"
                    "g wall\nv 0 0 0\nv 0 4 0\nv 0 4 2\nv 0 0 2\nusemtl white\nf 13 14 15 16\n");
}

}  // namespace transillum::viewer::test
