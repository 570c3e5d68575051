# transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
"""To and from PyVista, which is needed only when these functions are called."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Union

import numpy as np
import numpy.typing as npt

from ._scenes import Scene
from ._solves import Solution

if TYPE_CHECKING:
    import pyvista


def to_pyvista(data: Union[Scene, Solution]) -> pyvista.PolyData:
    """A mesh with a cell for each patch, in their order, and cell data: reflectance and exitance;
    of a solution also radiosity, irradiance and, from replicas, standard_error."""
    import pyvista

    scene = data.scene if isinstance(data, Solution) else data
    cells = np.concatenate([np.concatenate(([len(o)], o)) for o in scene.outlines])
    mesh = pyvista.PolyData(scene.points, cells)
    mesh.cell_data["reflectance"] = scene.reflectance
    mesh.cell_data["exitance"] = scene.exitance
    if isinstance(data, Solution):
        mesh.cell_data["radiosity"] = data.radiosity
        mesh.cell_data["irradiance"] = data.irradiance
        if data.standard_error is not None:
            mesh.cell_data["standard_error"] = data.standard_error
    return mesh


def from_pyvista(
    mesh: pyvista.PolyData,
    reflectance: Union[npt.ArrayLike, None] = None,
    exitance: Union[npt.ArrayLike, None] = None,
    **options: Any,
) -> Scene:
    """A scene of the polygons of a mesh.

    reflectance, exitance: as of Scene; None: the mesh's cell data of that name, or 0.5 and 0.
    options: further ones of Scene.
    """
    faces = _faces(mesh)

    def values(given: Union[npt.ArrayLike, None], name: str, default: float) -> npt.ArrayLike:
        if given is not None:
            return given
        return mesh.cell_data[name] if name in mesh.cell_data else default

    return Scene(
        np.asarray(mesh.points, dtype=np.float64),
        faces,
        values(reflectance, "reflectance", 0.5),
        values(exitance, "exitance", 0.0),
        **options,
    )


def _faces(mesh: pyvista.PolyData) -> list[list[int]]:
    flat: list[int] = np.asarray(mesh.faces).tolist()
    faces = []
    k = 0
    while k < len(flat):
        end = k + 1 + flat[k]
        faces.append(flat[k + 1 : end])
        k = end
    return faces
