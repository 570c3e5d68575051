# transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
"""Diffuse light in scenes of polygons, by the transillumination method.

    >>> import transillum
    >>> scene = transillum.load("cornell-box", patches=300)
    >>> solution = transillum.solve(scene, accuracy="1%")
    >>> solution.radiosity  # B, W/m², an array (N, 3)

Arrays are copies: changing them changes nothing else. Long calls let other threads of Python work
and end at Ctrl-C. Wrong values raise InputError, a ValueError; booleans for numbers, a TypeError.
"""

from ._core import InputError, __version__
from ._maps import Transfers, VisibilityMap, transfers, visibility_map
from ._pyvista import from_pyvista, to_pyvista
from ._scenes import Scene, TransillumWarning, built_in_scenes, load
from ._solves import Run, Solution, form_factors, options, picture, solve

__all__ = [
    "InputError",
    "Run",
    "Scene",
    "Solution",
    "Transfers",
    "TransillumWarning",
    "VisibilityMap",
    "__version__",
    "built_in_scenes",
    "form_factors",
    "from_pyvista",
    "load",
    "options",
    "picture",
    "solve",
    "to_pyvista",
    "transfers",
    "visibility_map",
]
