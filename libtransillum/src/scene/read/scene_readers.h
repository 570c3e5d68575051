// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <filesystem>
#include <string>

#include "transillum/scene.h"

namespace transillum {

/// Reads a scene file of one format. What is ignored or replaced is in SceneDescription::notes.
///   path, options (all but the scale, which describe_scene() applies), cancellation
/// Throws InputError naming the file, the place in it and what is wrong; Canceled; std::bad_alloc.
using SceneReader = SceneDescription(const std::filesystem::path&, const ReadOptions&,
                                     const Cancellation&);

/// An OBJ file and the MTL files it names: Kd is the reflectance, Ke the exitance. Faces keep their
/// order and all their corners; coordinates, Kd and Ke are the nearest doubles. A face's group is
/// the last `g` or `o` before it, with all names of the line.
SceneReader read_obj;

/// The triangles of all meshes of the scene of a glTF 2.0 file, .gltf or .glb, placed by its nodes,
/// which are the groups. Unless ReadOptions::join is false, triangles of one plane are joined
/// (join_faces()). Materials as GltfMaterials says; a face with textures has their average over it.
/// Lengths are meters.
SceneReader read_gltf;

/// The polygons of a PLY file, ASCII or binary. Colors of faces, else of vertices, are the
/// reflectance: whole numbers of 0 to 255 by the transfer function of sRGB, others as they are.
/// Properties rho_r, rho_g, rho_b and E_r, E_g, E_b of faces, as write_result() writes them, come
/// before colors.
SceneReader read_ply;

/// The triangles of an STL file, ASCII or binary; corners with equal coordinates are one point. The
/// solids of an ASCII file are its groups. Normals and attributes are ignored.
SceneReader read_stl;

/// The polygons of an ASCII OFF file, also with normals and colors of vertices, which are ignored.
/// Colors of faces are the reflectance: whole numbers of 0 to 255 by the transfer function of sRGB,
/// fractions as they are.
SceneReader read_off;

/// The polygons of a Radiance scene description (.rad), which are groups by their names. plastic,
/// metal and trans: rho = color (1 - specularity); light, glow, illum and spotlight: E = pi times
/// their radiance. Other surfaces and lights are omitted and noted; commands (`!`) are refused.
SceneReader read_radiance;

/// The vertices and surfaces of a View3D file (.vs3, geometry 3). A surface with emissivity e has
/// rho = 1 - e; obstructions have rho = 0. Subsurfaces are cut out of their base; Patch::face
/// counts surfaces in the order of the file. Combined surfaces are one group; others have a group
/// each, with the surface's name.
SceneReader read_view3d;

/// The polygons and strips of a .vtp file of VTK: rho and E as in a result, else colors.
SceneReader read_vtp;

/// The same of a legacy .vtk file, ASCII or binary, versions 1 to 5.
SceneReader read_vtk;

/// Reads a file whose name ends as one of scene_formats(), and joins its faces as `options` say.
/// @throws InputError, Canceled
SceneDescription read_scene_file(const std::string& path, const ReadOptions& options,
                                 const Cancellation& cancellation);

}  // namespace transillum
