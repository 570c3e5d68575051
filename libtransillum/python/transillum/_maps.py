# transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
"""Visible areas of patches along one direction."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Union

import numpy.typing as npt

from . import _core
from ._numbers import array, number
from ._scenes import Indices, Scene, Values


@dataclass(frozen=True)
class Transfers:
    """The areas that patches see of each other along a direction omega and its opposite."""

    direction: tuple[float, float, float]
    """omega, unit, from the receiver toward the source."""
    receiver: Indices
    """i of each exchange."""
    source: Indices
    """j of each exchange."""
    area: Values
    """A(i, j, omega): the area over which i sees j, on the plane perpendicular to omega, m². It
    equals A(j, i, -omega)."""
    forward: tuple[Values, Values]
    """For each patch as receiver along omega: area of its projection, and the part of it with
    something above, m²."""
    backward: tuple[Values, Values]
    """The same along -omega."""
    closure_defect: float
    """Largest difference between the two over the projected area; only rounding in a closed scene."""


@dataclass(frozen=True)
class Polygon:
    """A convex polygon of a visibility map."""

    patch: int
    """The patch that is visible there."""
    front_facing: bool
    """Its back is visible, and it receives; else its front, and it emits."""
    area: float
    """m²."""
    corners: Values
    """(K, 2), m, on the plane; counterclockwise from its first axis to its second."""


class VisibilityMap:
    """The surfaces visible along a direction. A notebook draws it."""

    def __init__(self, core: _core.VisibilityMap) -> None:
        self._core = core

    def __repr__(self) -> str:
        return f"<transillum.VisibilityMap of {len(self.polygons)} polygons>"

    @property
    def frame(self) -> tuple[tuple[float, float, float], ...]:
        """Origin, first and second axis of the plane, and omega."""
        return self._core.frame

    @property
    def polygons(self) -> list[Polygon]:
        """By patch."""
        return [Polygon(*polygon) for polygon in self._core.polygons]

    def svg(self, size: int = 600) -> str:
        """The map as a picture of `size` pixels, seen along the direction."""
        return self._core.svg(number("size", size))

    def _repr_svg_(self) -> str:
        return self.svg()


def transfers(scene: Scene, direction: npt.ArrayLike, **options: Any) -> Transfers:
    """Runs an engine along a direction.

    direction: three numbers, not all 0.
    options: engine, and those that belong to it.
    """
    return Transfers(**_core.transfers(scene._core, array("direction", direction), options))


def visibility_map(
    scene: Scene, direction: npt.ArrayLike, patch: Union[int, None] = None
) -> VisibilityMap:
    """The visibility map along a direction.

    patch: what that patch sees; None: what is visible from below the scene.
    """
    return VisibilityMap(
        _core.visibility_map(scene._core, array("direction", direction), number("patch", patch))
    )
