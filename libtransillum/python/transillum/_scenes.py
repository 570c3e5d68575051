# transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
"""Scenes of patches."""

from __future__ import annotations

import operator
import warnings
from typing import Sequence, Union

import numpy as np
import numpy.typing as npt

from . import _core
from ._numbers import array, number

Values = npt.NDArray[np.float64]
Indices = npt.NDArray[np.int32]


class TransillumWarning(UserWarning):
    """A scene was repaired, or may not be what was meant."""


class Scene:
    """Flat patches that emit and reflect light on their front sides. Never changes.

    N is the number of patches, ``len(scene)``.
    """

    def __init__(
        self,
        points: npt.ArrayLike,
        faces: Sequence[Sequence[int]],
        reflectance: npt.ArrayLike = 0.5,
        exitance: npt.ArrayLike = 0.0,
        *,
        two_sided: bool = False,
        max_patch_area: float = 0,
        patches: int = 0,
        name: str = "scene",
    ) -> None:
        """Builds a scene from faces.

        points: array (P, 3), m.
        faces: for each, indices into points, counterclockwise seen from the front side, which
            emits and receives.
        reflectance: rho, at least 0 and below 1; one value, three for red, green and blue, one
            for each face, or an array (faces, 3). Three values for three faces are one color.
        exitance: E, emitted, W/m²; as reflectance.
        two_sided: faces emit and receive on both sides: two patches each, front first.
        max_patch_area: larger faces are subdivided, m²; 0 subdivides none.
        patches: subdivides to about so many patches; 0 subdivides none.
        """
        self._core = _core.build(
            array("points", points),
            _indices(faces),
            array("reflectance", reflectance),
            array("exitance", exitance),
            _division(two_sided, max_patch_area, patches),
            name,
        )
        _warn(self._core)

    @classmethod
    def _of(cls, core: _core.Scene) -> Scene:
        scene = cls.__new__(cls)
        scene._core = core
        return scene

    def __len__(self) -> int:
        return len(self._core)

    def __repr__(self) -> str:
        return f"<transillum.Scene {self.name!r}: {len(self)} patches>"

    @property
    def name(self) -> str:
        """The file or the built-in scene."""
        return self._core.name

    @property
    def points(self) -> Values:
        """All points, (P, 3), m."""
        return self._core.points

    @property
    def outlines(self) -> list[Indices]:
        """For each patch, indices into points, counterclockwise seen from its front side."""
        begin, corners = self._core.outlines
        return np.split(corners, begin[1:-1])

    @property
    def area(self) -> Values:
        """(N,), m²."""
        return self._core.area

    @property
    def normal(self) -> Values:
        """Unit vectors on the front sides, (N, 3)."""
        return self._core.normal

    @property
    def center(self) -> Values:
        """Centroids, (N, 3), m."""
        return self._core.center

    @property
    def reflectance(self) -> Values:
        """rho, (N, 3)."""
        return self._core.reflectance

    @property
    def exitance(self) -> Values:
        """E, (N, 3), W/m²."""
        return self._core.exitance

    @property
    def face(self) -> Indices:
        """The number of the face that each patch is a part of, (N,)."""
        return self._core.face

    @property
    def group(self) -> Indices:
        """Index into groups of each patch, or -1, (N,)."""
        return self._core.group

    @property
    def groups(self) -> list[str]:
        """Names of the groups of faces."""
        return self._core.groups

    @property
    def warnings(self) -> list[str]:
        """Repairs, and what may be wrong."""
        return self._core.warnings


def load(
    spec: str,
    *,
    two_sided: bool = False,
    max_patch_area: float = 0,
    patches: int = 0,
    scale: float = 1,
    join: Union[bool, None] = None,
    default_reflectance: float = 0.5,
) -> Scene:
    """Reads a scene file or makes a built-in scene.

    spec: path of a file (OBJ, glTF, PLY, STL, OFF, VTK, Radiance, View3D), or a name of
        built_in_scenes(), with parameters as in "sphere-flake:levels=2,slices=17,stacks=8".
    two_sided, max_patch_area, patches: as of Scene.
    scale: meters per unit of the coordinates.
    join: joins faces of one plane and material that share edges; None: of glTF and STL files.
    default_reflectance: of faces without a material.
    """
    core = _core.load(
        str(spec),
        _division(two_sided, max_patch_area, patches),
        (number("scale", scale), join, number("default_reflectance", default_reflectance)),
    )
    _warn(core)
    return Scene._of(core)


def built_in_scenes() -> dict[str, str]:
    """Names of the built-in scenes, each with what it is."""
    return {name: summary for name, summary, _ in _core.built_in_scenes()}


def _division(
    two_sided: bool, max_patch_area: float, patches: int
) -> tuple[bool, float, int]:
    return (
        two_sided,
        number("max_patch_area", max_patch_area),
        number("patches", patches),
    )


def _indices(faces: Sequence[Sequence[int]]) -> list[list[int]]:
    """The indices as int; other numbers would be rounded down."""
    lists: list[list[int]] = []
    for face in faces:
        try:
            if any(isinstance(corner, (bool, np.bool_)) for corner in face):
                raise TypeError
            lists.append([operator.index(corner) for corner in face])
        except TypeError:
            raise _core.InputError(
                f"faces: face {len(lists)} is {face!r}, not integers, indices into points"
            ) from None
    return lists


def _warn(core: _core.Scene) -> None:
    for text in core.warnings:
        warnings.warn(text, TransillumWarning, stacklevel=3)
